// A dressed person's surfaces in a pose, for images and silhouettes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "skinning/body/surface.h"
#include "skinning/image.h"

namespace throng::skinning {

/// A surface with posed vertices. The referenced objects must outlive it.
struct PosedSurface {
  const Surface* surface = nullptr;
  std::vector<Eigen::Vector3f> points;  ///< per vertex, m
  const Image* image = nullptr;
};

/// The texel of an image at texture coordinates in [0, 1].
const std::uint8_t* texel_at(const Image& image, const Eigen::Vector2f& uv);

/// Texture coordinates of a point, given by barycentric coordinates, of the triangle whose first
/// index is at `at`.
Eigen::Vector2f uv_within(const Surface& surface, std::size_t at,
                          const Eigen::Vector3f& barycentric);

/// Whether a point of the surface passes the alpha test; true for surfaces without alpha test.
bool is_there(const PosedSurface& posed, std::size_t at, const Eigen::Vector3f& barycentric);

}  // namespace throng::skinning
