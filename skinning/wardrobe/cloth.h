// Makes textures for clothes that are tinted per instance, with only light and shade.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <span>

#include "skinning/body/makehuman.h"
#include "skinning/image.h"
#include "skinning/wardrobe/outfit.h"

namespace throng::skinning {

/// Median sRGB value of a tinted piece's texture: bright enough for white shirts, dark enough for
/// highlights.
inline constexpr std::uint8_t kMedianShade = 205;

/// The shade of the deepest folds of plain cloth, of kMedianShade: black cloth still reflects as
/// much there as CIE L = 6.
inline constexpr double kMinFold = 0.72;

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

/// Adds the cloth's pattern, projected on the unmorphed body in the A-pose; `accent` multiplies the
/// color where the pattern has a second one.
void paint_pattern(Image& image, const ClothFaces& faces, Cloth cloth, const Rgb& accent);

/// Multiplies alpha by a function of the place on the unmorphed body.
void thin_out(Image& image, const ClothFaces& faces,
              const std::function<float(const Eigen::Vector3f&)>& density_at);

/// Hair from its image: the painted strands without broad shades, finer strands that run down from
/// the crown, and highlights where the light from above falls.
void paint_strands(Image& image, const ClothFaces& faces, const Mask& covered);

}  // namespace throng::skinning
