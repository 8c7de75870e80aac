// Bodies in the distance as the CPU paints them: render/people/distant_painter.h.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/people/people_meshes.h"
#include "skinning/population.h"

namespace throng::render {

/// A vertex that moves with one bone.
struct DistantVertex {
  Eigen::Vector4f rest;    ///< rest position, m, model axes; w = 1
  std::uint32_t bone = 0;  ///< place in DistantMesh::bones
};

/// A triangle, counter-clockwise from outside, about as small as a pixel: it has one color and one
/// normal, means of its corners'. Colors are linear; w is unused.
struct DistantTriangle {
  std::array<std::uint32_t, 3> corners{};
  std::uint32_t bone = 0;  ///< place in DistantMesh::bones of the bone that turns the normal
  /// In the rest pose. As long as the mean comes out: light on it is the mean of the light on the
  /// corners.
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Eigen::Array4f base = Eigen::Array4f::Zero();    ///< color of the texture, without the tint
  Eigen::Array4f shades = Eigen::Array4f::Zero();  ///< of a portrait, by top, bottom, hair, shoes
  std::uint32_t tint = 0;                          ///< skinning::Tint
};

/// The level for the distance of one character. Without triangles it cannot be painted: some
/// vertices move with several bones, or parts are transparent or separate objects.
struct DistantMesh {
  std::vector<std::uint32_t> bones;  ///< indices into palettes
  std::vector<DistantVertex> vertices;
  std::vector<DistantTriangle> triangles;
};

DistantMesh distant_mesh(const PackedMesh& packed);

}  // namespace throng::render
