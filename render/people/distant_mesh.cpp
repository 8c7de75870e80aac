#include "render/people/distant_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/compute/srgb.h"

namespace throng::render {

namespace {

std::uint8_t nth_byte(std::uint32_t word, std::size_t i) {
  return static_cast<std::uint8_t>(word >> (8 * i));
}

/// The four bytes of a word, the first one lowest, as shares of 255.
Eigen::Array4f shares(std::uint32_t word) {
  return Eigen::Array4f(nth_byte(word, 0), nth_byte(word, 1), nth_byte(word, 2),
                        nth_byte(word, 3)) /
         255;
}

/// The color of a word's first three bytes, sRGB.
Eigen::Array4f linear_color(std::uint32_t word) {
  return {linear_from_srgb(nth_byte(word, 0)), linear_from_srgb(nth_byte(word, 1)),
          linear_from_srgb(nth_byte(word, 2)), 0};
}

/// The unit vector that people_meshes.cpp folded onto an octahedron.
Eigen::Vector3f unfolded(std::uint32_t word) {
  const auto share = [](std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int16_t>(bits & 0xFFFFU)) / 32767;
  };
  Eigen::Vector3f normal(share(word), share(word >> 16U), 0);
  normal.z() = 1 - std::abs(normal.x()) - std::abs(normal.y());
  const float fold = std::max(-normal.z(), 0.0F);
  normal.x() -= std::copysign(fold, normal.x());
  normal.y() -= std::copysign(fold, normal.y());
  return normal.normalized();
}

bool has_one_bone(const DeviceVertex& vertex) { return (vertex.weights >> 8U) == 0; }

bool is_apart(const DeviceVertex& vertex) { return (vertex.part >> 31U) != 0; }

/// The place of a value in a list that it is appended to if it is missing.
std::uint32_t place_in(std::vector<std::uint32_t>& list, std::uint32_t value) {
  const auto found = std::find(list.begin(), list.end(), value);
  const auto place = static_cast<std::uint32_t>(found - list.begin());
  if (found == list.end()) list.push_back(value);
  return place;
}

}  // namespace

DistantMesh distant_mesh(const PackedMesh& packed) {
  DistantMesh mesh;
  const bool can_be_painted =
      !packed.has_transparent_parts &&
      std::all_of(packed.vertices.begin(), packed.vertices.end(), [](const DeviceVertex& vertex) {
        return has_one_bone(vertex) && !is_apart(vertex);
      });
  if (!can_be_painted) return mesh;
  for (const DeviceVertex& vertex : packed.vertices) {
    DistantVertex& added = mesh.vertices.emplace_back();
    added.rest << vertex.position[0], vertex.position[1], vertex.position[2], 1;
    added.bone = place_in(mesh.bones, vertex.bones & 0xFFU);
  }
  for (std::size_t i = 0; i + 2 < packed.indices.size(); i += 3) {
    DistantTriangle& added = mesh.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      added.corners[k] = packed.indices[i + k];
      const DeviceVertex& vertex = packed.vertices[added.corners[k]];
      added.normal += unfolded(vertex.normal) / 3;
      added.base += linear_color(vertex.base) / 3;
      added.shades += shares(vertex.shades) / 3;
      added.tint = (vertex.part >> 24U) & 0x7FU;
    }
    added.bone = mesh.vertices[added.corners[0]].bone;
  }
  return mesh;
}

}  // namespace throng::render
