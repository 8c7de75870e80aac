// Headwear and hair that are made from the base mesh's head, because the package has none:
// caps, knitted hats, headscarves, scarves around the neck, beards and cropped hair.
#pragma once

#include <string_view>

#include "skinning/body/makehuman.h"
#include "skinning/image.h"

namespace throng::skinning {

inline constexpr std::string_view kCap = "helper-cap";
inline constexpr std::string_view kKnittedHat = "helper-knitted-hat";
inline constexpr std::string_view kHeadscarf = "helper-headscarf";
inline constexpr std::string_view kScarf = "helper-scarf";
inline constexpr std::string_view kBeard = "helper-beard";
inline constexpr std::string_view kMoustache = "helper-moustache";
inline constexpr std::string_view kCropped = "helper-cropped-hair";
inline constexpr std::string_view kReceding = "helper-receding-hair";

/// Whether a garment is made by this program instead of taken from the package.
bool is_made_here(std::string_view garment);

/// The item, which must be one of those above, attached to the vertices of the head and neck below
/// it. Its texture coordinates run once around and from its top to its bottom.
Proxy make_headwear(const MakeHuman& makehuman, std::string_view name);

/// How dense hair is at a point (m) of the unmorphed head, from 0 to 1: 1 for what is not hair.
float hair_density(std::string_view name, const Eigen::Vector3f& point);

/// Its texture: light and shade; alpha is the density of hair where hair_density() is 1.
Image headwear_cloth(std::string_view name, int size);

}  // namespace throng::skinning
