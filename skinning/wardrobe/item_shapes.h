// The shapes of carried items: boxes, straps and domes around the dressed person.
#pragma once

#include <optional>
#include <string_view>

#include "skinning/body/surface.h"
#include "skinning/image.h"
#include "skinning/population.h"
#include "skinning/wardrobe/dress.h"

namespace throng::skinning {

/// Key of the common texture of all carried items, and its image: light and shade of cloth with
/// seams, to be tinted.
inline constexpr std::string_view kItemTexture = "items";
Image item_image(int size);

/// The carried item in the neutral stance for a level of detail: 0 is the finest, 3 and above the
/// coarsest. Nothing for Carry::nothing. Surface::fitted equals the positions in the neutral
/// stance.
std::optional<Surface> make_item(Carry carry, const DressedPerson& person, int level);

}  // namespace throng::skinning
