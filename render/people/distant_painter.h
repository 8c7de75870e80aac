// Paints people in the distance on the CPU. Their triangles are about as small as a pixel, and a
// software driver spends more on setting up each of them than on its pixels (docs/rendering.md has
// figures). A painted image holds the depth, person, albedo and received light of each pixel;
// shaders/distant.frag.glsl adds the sun, its shadows and the air.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "camera/camera.h"
#include "render/frame/pixel_mask.h"
#include "render/frame/pixel_weights.h"
#include "render/light/light_bake.h"
#include "render/people/distant_mesh.h"
#include "render/people/person_geometry.h"
#include "skinning/appearance.h"

namespace throng::render {

/// A painted pixel.
struct PaintedPixel {
  float depth;           ///< kNear / z, as in the depth buffer; 0: nothing
  std::uint32_t id;      ///< as in Frame::id
  std::uint32_t albedo;  ///< square roots of linear light, of 255, red lowest; then kSunBits
  std::uint32_t light;   ///< received but for the sun's: square roots, 10 bits each, red lowest
};

/// The share of sunlight that a surface receives for how it is turned, of 255.
inline constexpr unsigned kSunBits = 24;
/// The light that the largest square root stands for; also in shaders/distant.frag.glsl.
inline constexpr float kMaxLight = 16;

/// The whole silhouette of a person: exactly the pixels that would be painted if nobody were in
/// front.
class PaintedShape {
 public:
  /// Widest and tallest people that are painted, px.
  static constexpr int kMaxPx = 64;

  void begin(const Eigen::Vector2i& first, int rows);
  void put(int x, int y) {
    rows_[static_cast<std::size_t>(y - first_.y())] |= std::uint64_t{1} << (x - first_.x());
  }
  /// Number of pixels, weighted by `weights` (null: 1).
  std::uint64_t area(const PixelWeights* weights) const;
  PixelMask mask() const;

 private:
  Eigen::Vector2i first_ = Eigen::Vector2i::Zero();
  int count_ = 0;
  std::array<std::uint64_t, kMaxPx> rows_{};
};

class DistantPainter {
 public:
  /// Pixels along each side of a tile.
  static constexpr int kTilePx = 16;

  /// Begins an image without people. `sun` is the direction toward the sun.
  void begin(const camera::Camera& camera, const Eigen::Vector3f& sun);

  /// A person to be painted.
  struct Person {
    const DistantMesh& mesh;
    const skinning::Palette& palette;
    const skinning::Appearance& appearance;
    Stance stance;
    LightField light;  ///< around the person
    std::uint32_t id;  ///< as in Frame::id
  };

  /// Paints a person in front of what is farther, and sets `shape`. Returns false, and paints
  /// nothing, if the person reaches out of the image or is larger than PaintedShape::kMaxPx.
  bool paint(const Person& person, PaintedShape& shape);

  /// First pixels of the tiles with people. Pixels of other tiles are those of earlier images.
  const std::vector<Eigen::Vector2i>& tiles() const { return tiles_; }
  /// All pixels, row by row, `width` in a row.
  const std::vector<PaintedPixel>& pixels() const { return pixels_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  /// A vertex in the image.
  struct Corner {
    int x = 0;  ///< in box coordinates, 1 / 256 pixel
    int y = 0;
    float depth = 0;
  };
  /// Tints in linear light, by skinning::Tint.
  using LinearTints = std::array<Eigen::Array4f, skinning::kTintCount>;

  static LinearTints linear_tints(const skinning::Appearance& appearance);
  bool place_corners(const Person& person);
  void clear_tiles(const Eigen::AlignedBox2i& pixels);
  void fill(const Person& person, const DistantTriangle& triangle, PaintedShape& shape);
  PaintedPixel color_of(const Person& person, const DistantTriangle& triangle) const;

  camera::Camera camera_;
  Eigen::Vector3f sun_ = Eigen::Vector3f::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<PaintedPixel> pixels_;
  std::vector<Eigen::Vector2i> tiles_;
  std::vector<std::uint32_t> tile_image_;  ///< number of the image that each tile shows
  std::uint32_t image_ = 0;
  // These belong to the person that is being painted.
  std::vector<Corner> corners_;
  std::array<Eigen::Matrix3f, skinning::kBoneCount> turns_;  ///< from the rest pose to the world
  LinearTints tints_;
};

}  // namespace throng::render
