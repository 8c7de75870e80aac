// The shapes of carried items, made of boxes, straps and domes around the dressed person.
#pragma once

#include <optional>
#include <string_view>

#include "skinning/body/surface.h"
#include "skinning/image.h"
#include "skinning/population.h"
#include "skinning/wardrobe/dress.h"

namespace throng::skinning {

/// Key of the texture that all carried items share, and the image: light and shade of cloth with
/// seams, to be tinted.
inline constexpr std::string_view kItemTexture = "items";
Image item_image(int size);

/// The carried item in the neutral pose, as part of one level of detail: 0 is the finest, 3 and
/// above the coarsest. Nothing for Carry::nothing. Its `fitted` positions are the neutral ones.
std::optional<Surface> make_item(Carry carry, const DressedPerson& person, int level);

}  // namespace throng::skinning
