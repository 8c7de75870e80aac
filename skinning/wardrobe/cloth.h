// Paints textures for clothes that are colored per instance: light and shade only.
#pragma once

#include <filesystem>
#include <span>

#include "skinning/body/makehuman.h"
#include "skinning/image.h"
#include "skinning/wardrobe/outfit.h"

namespace throng::skinning {

/// sRGB value that the median of a tinted piece's texture has: bright enough for white shirts, dark
/// enough for highlights.
inline constexpr std::uint8_t kMedianShade = 205;

/// Some faces of a proxy, all on one image.
struct ClothFaces {
  const Proxy* proxy;
  std::span<const Quad> quads;
};

/// The texels that the faces use.
Mask covered_by(const ClothFaces& faces, const Image& image);

/// The image of a garment in its folder's textures/: the package's own, not its normal or
/// occlusion map. Throws InputError when there is none.
std::filesystem::path diffuse_image(const std::filesystem::path& folder);

/// Light and shade of the image under `covered`, without color and with its median at
/// kMedianShade; `contrast` is an exponent on brightness.
void reduce_to_shade(Image& image, const Mask& covered, double contrast);

/// Folds as the garment's occlusion and normal maps show them, without any print; light and shade
/// of its image where the package has no such maps.
Image plain_cloth(const std::filesystem::path& folder, const Mask& covered);

/// Adds the cloth's pattern, laid out on the unmorphed body in the A-pose.
void paint_pattern(Image& image, const ClothFaces& faces, Cloth cloth);

}  // namespace throng::skinning
