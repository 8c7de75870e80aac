// Amodal areas of people who extend beyond the image (for others see silhouettes.h). Each person is
// rendered separately into a tile of an atlas, moved by whole pixels, so that the rasterizer makes
// the same decisions as in the image.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "render/frame/pixel_mask.h"
#include "render/frame/pixel_weights.h"
#include "render/gl/gl_objects.h"
#include "render/people/people_pass.h"

namespace throng::render {

/// A person to be measured, and the pixels [min, max) of the silhouette within the measured ones,
/// with a pixel more on each side.
struct CoverageRequest {
  PersonDraw draw;
  Eigen::AlignedBox2i bounds;
};

class CoverageCounter {
 public:
  CoverageCounter();

  /// Returns the number of covered pixels for each request, including pixels beyond the image,
  /// weighted by `weights` (null: 1). Requests are limited to the pixels `measured`. Sets the
  /// covered pixels in `masks`, which is empty or has one mask per request. Leaves its own target,
  /// viewport and View block bound.
  std::vector<std::uint64_t> count(PeoplePass& pass, std::span<const PersonInstance> people,
                                   std::span<const CoverageRequest> requests,
                                   const camera::Camera& camera,
                                   const Eigen::AlignedBox2i& measured,
                                   const PixelWeights* weights = nullptr,
                                   std::span<PixelMask> masks = {});

 private:
  /// A part of a request's bounds that fits into the atlas, and its position there.
  struct Tile {
    std::size_t request = 0;
    Eigen::Vector2i image = Eigen::Vector2i::Zero();  ///< its first pixel in the image
    Eigen::Vector2i size = Eigen::Vector2i::Zero();
    Eigen::Vector2i atlas = Eigen::Vector2i::Zero();
    bool holds_all = true;  ///< contains the whole silhouette, neither divided nor limited
  };

  static std::vector<Tile> tiles_of(std::span<const CoverageRequest> requests,
                                    const Eigen::AlignedBox2i& measured);
  /// Places tiles from `first` on in rows until the atlas is full; returns the index after the last
  /// one placed.
  static std::size_t place(std::vector<Tile>& tiles, std::size_t first, int& used_rows);
  std::uint64_t covered_in(const Tile& tile, const PixelWeights* weights) const;
  void draw_and_add(PeoplePass& pass, std::span<const PersonInstance> people,
                    std::span<const CoverageRequest> requests, std::span<const Tile> tiles,
                    int used_rows, const PixelWeights* weights, std::vector<std::uint64_t>& counts,
                    std::span<PixelMask> masks);
  void add_to_mask(const Tile& tile, PixelMask& mask) const;

  Texture atlas_;
  Framebuffer framebuffer_;
  Buffer view_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace throng::render
