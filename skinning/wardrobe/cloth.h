// Makes textures for clothes that are tinted per instance, with only light and shade.
#pragma once

#include <filesystem>
#include <span>

#include "skinning/body/makehuman.h"
#include "skinning/image.h"
#include "skinning/wardrobe/outfit.h"

namespace throng::skinning {

/// Median sRGB value of a tinted piece's texture: bright enough for white shirts, dark enough for
/// highlights.
inline constexpr std::uint8_t kMedianShade = 205;

/// Faces of a proxy that share an image.
struct ClothFaces {
  const Proxy* proxy;
  std::span<const Quad> quads;
};

/// The texels that the faces cover.
Mask covered_by(const ClothFaces& faces, const Image& image);

/// The color image of a garment in textures/ of its folder, not its normal or occlusion map. Throws
/// InputError if there is none.
std::filesystem::path diffuse_image(const std::filesystem::path& folder);

/// Reduces the image within `covered` to light and shade, without color and with the median
/// kMedianShade; `contrast` is an exponent on brightness.
void reduce_to_shade(Image& image, const Mask& covered, double contrast);

/// The folds of a garment from its occlusion and normal maps, without prints; or the light and
/// shade of its image if the package has no such maps.
Image plain_cloth(const std::filesystem::path& folder, const Mask& covered);

/// Adds the cloth's pattern, projected on the unmorphed body in the A-pose.
void paint_pattern(Image& image, const ClothFaces& faces, Cloth cloth);

}  // namespace throng::skinning
