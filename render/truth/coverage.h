// How many pixels a person would cover with nothing in front, for those who reach beyond the image
// (others: silhouettes.h): each is rendered alone into a tile of an atlas, moved by whole pixels so
// that the rasterizer makes the same decisions as in the image.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "render/gl/gl_objects.h"
#include "render/people/people_pass.h"
#include "render/pixel_mask.h"
#include "render/pixel_weights.h"

namespace throng::render {

/// The person to measure, and the image pixels [min, max) of the silhouette, with its limits
/// (render/people/person_geometry.h).
struct CoverageRequest {
  PersonDraw draw;
  Eigen::AlignedBox2i bounds;
};

class CoverageCounter {
 public:
  CoverageCounter();

  /// Covered pixels for each request, also those outside the image, weighted by `weights`, or once
  /// each; `masks`, if given, one for each request, get those that lie in them. Leaves its own
  /// target, viewport and View block bound.
  std::vector<std::uint64_t> count(PeoplePass& pass, std::span<const PersonInstance> people,
                                   std::span<const CoverageRequest> requests,
                                   const camera::Camera& camera,
                                   const PixelWeights* weights = nullptr,
                                   std::span<PixelMask> masks = {});

 private:
  /// A part of a request's bounds that fits the atlas, and where it lies there.
  struct Tile {
    std::size_t request = 0;
    Eigen::Vector2i image = Eigen::Vector2i::Zero();  ///< its first pixel
    Eigen::Vector2i size = Eigen::Vector2i::Zero();
    Eigen::Vector2i atlas = Eigen::Vector2i::Zero();
    bool holds_all = true;  ///< the whole silhouette, which is neither cut into tiles nor limited
  };

  static std::vector<Tile> tiles_of(std::span<const CoverageRequest> requests,
                                    const camera::Intrinsics& image);
  /// Places tiles from `first` on in rows until the atlas is full; returns the end of the placed.
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
