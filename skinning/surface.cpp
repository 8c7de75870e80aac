#include "skinning/surface.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace throng::skinning {

namespace {

// Area-weighted normals, summed over all vertices that came from the same source vertex.
void compute_normals(Surface& surface, std::size_t source_count) {
  std::vector<Eigen::Vector3f> sums(source_count, Eigen::Vector3f::Zero());
  for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
    const std::uint32_t a = surface.indices[at];
    const std::uint32_t b = surface.indices[at + 1];
    const std::uint32_t c = surface.indices[at + 2];
    const Eigen::Vector3f normal = (surface.positions[b] - surface.positions[a])
                                       .cross(surface.positions[c] - surface.positions[a]);
    for (const std::uint32_t vertex : {a, b, c}) sums[surface.source[vertex]] += normal;
  }
  surface.normals.resize(surface.positions.size());
  for (std::size_t vertex = 0; vertex < surface.normals.size(); ++vertex) {
    const Eigen::Vector3f& sum = sums[surface.source[vertex]];
    surface.normals[vertex] = sum.norm() > 0 ? sum.normalized() : Eigen::Vector3f::UnitZ();
  }
}

std::array<float, 3> array_of(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

Surface make_surface(std::span<const Quad> quads, std::span<const Eigen::Vector2f> uvs,
                     std::span<const Eigen::Vector3f> fitted, std::span<const BoneWeights> weights,
                     const Palette& to_neutral) {
  Surface surface;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  const auto vertex_of = [&](const Quad& quad, std::size_t corner) {
    const std::uint32_t source = quad.vertex[corner];
    const auto [entry, is_new] = known.try_emplace(
        {source, quad.uv[corner]}, static_cast<std::uint32_t>(surface.source.size()));
    if (is_new) {
      surface.source.push_back(source);
      surface.fitted.push_back(fitted[source]);
      surface.positions.push_back(move_point(fitted[source], weights[source], to_neutral));
      surface.uvs.push_back(uvs[quad.uv[corner]]);
      surface.weights.push_back(weights[source]);
    }
    return entry->second;
  };
  for (const Quad& quad : quads) {
    std::array<std::uint32_t, 4> vertex{};
    for (std::size_t corner = 0; corner < 4; ++corner) vertex[corner] = vertex_of(quad, corner);
    for (const std::size_t corner : {0, 1, 2, 0, 2, 3}) {
      surface.indices.push_back(vertex[corner]);
    }
  }
  compute_normals(surface, fitted.size());
  return surface;
}

Eigen::Vector3f move_point(const Eigen::Vector3f& point, const BoneWeights& weights,
                           const Palette& palette) {
  Eigen::Vector3f moved = Eigen::Vector3f::Zero();
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    if (weights[bone] > 0) moved += weights[bone] * (palette[bone] * point.homogeneous());
  }
  return moved;
}

void set_weights(Vertex& vertex, const BoneWeights& weights) {
  std::array<std::size_t, kBoneCount> order{};
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  float sum = 0;
  for (std::size_t slot = 0; slot < 4; ++slot) sum += weights[order[slot]];
  int left = 255;
  for (std::size_t slot = 3; slot > 0; --slot) {
    const int share = std::min(
        left, static_cast<int>(std::lround(255 * weights[order[slot]] / std::max(sum, 1e-6F))));
    vertex.bones[slot] = share > 0 ? static_cast<std::uint8_t>(order[slot]) : 0;
    vertex.weights[slot] = static_cast<std::uint8_t>(share);
    left -= share;
  }
  vertex.bones[0] = static_cast<std::uint8_t>(order[0]);
  vertex.weights[0] = static_cast<std::uint8_t>(left);
}

void simplify(Surface& surface, std::size_t triangles) {
  if (3 * triangles >= surface.indices.size()) return;
  std::vector<std::uint32_t> indices(surface.indices.size());
  constexpr float kWorstError = 0.05F;  // relative to the surface's size
  indices.resize(meshopt_simplify(indices.data(), surface.indices.data(), surface.indices.size(),
                                  surface.positions.front().data(), surface.positions.size(),
                                  sizeof(Eigen::Vector3f), 3 * triangles, kWorstError, 0, nullptr));
  surface.indices = std::move(indices);
}

Mesh assemble(std::span<const Surface> surfaces, const std::map<std::string, int>& texture_of) {
  Mesh mesh;
  for (const Surface& surface : surfaces) {
    if (surface.indices.empty()) continue;
    constexpr std::uint32_t kUnused = 0xFFFFFFFF;
    std::vector<std::uint32_t> place(surface.positions.size(), kUnused);
    const auto first_index = static_cast<std::uint32_t>(mesh.indices.size());
    for (const std::uint32_t index : surface.indices) {
      if (place[index] == kUnused) {
        place[index] = static_cast<std::uint32_t>(mesh.vertices.size());
        Vertex vertex{};
        vertex.position = array_of(surface.positions[index]);
        vertex.normal = array_of(surface.normals[index]);
        vertex.uv = {surface.uvs[index].x(), surface.uvs[index].y()};
        set_weights(vertex, surface.weights[index]);
        mesh.vertices.push_back(vertex);
      }
      mesh.indices.push_back(place[index]);
    }
    mesh.parts.push_back({first_index, static_cast<std::uint32_t>(surface.indices.size()),
                          texture_of.at(surface.texture), surface.tint, surface.alpha_tested});
  }
  return mesh;
}

}  // namespace throng::skinning
