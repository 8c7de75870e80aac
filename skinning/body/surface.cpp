#include "skinning/body/surface.h"

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

std::array<float, 3> to_array(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

// A new vertex between two.
std::uint32_t add_between(Surface& surface, std::uint32_t a, std::uint32_t b, float share_of_b) {
  const float share_of_a = 1 - share_of_b;
  surface.source.push_back(surface.source[share_of_b < 0.5F ? a : b]);
  surface.fitted.push_back(share_of_a * surface.fitted[a] + share_of_b * surface.fitted[b]);
  surface.positions.push_back(share_of_a * surface.positions[a] +
                              share_of_b * surface.positions[b]);
  surface.normals.push_back(
      (share_of_a * surface.normals[a] + share_of_b * surface.normals[b]).normalized());
  surface.uvs.push_back(share_of_a * surface.uvs[a] + share_of_b * surface.uvs[b]);
  BoneWeights weights;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    weights[bone] = share_of_a * surface.weights[a][bone] + share_of_b * surface.weights[b][bone];
  }
  surface.weights.push_back(weights);
  return static_cast<std::uint32_t>(surface.source.size() - 1);
}

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

BoneMatrix mixed(const Palette& palette, const BoneWeights& weights) {
  BoneMatrix matrix = BoneMatrix::Zero();
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    if (weights[bone] > 0) matrix += weights[bone] * palette[bone];
  }
  return matrix;
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
  std::array<std::size_t, kBoneCount + 1> order{};
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

void cut_surface(Surface& surface, std::span<const float> value) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> borders;
  const auto border_on = [&](std::uint32_t in, std::uint32_t out) {
    const auto [entry, is_new] = borders.try_emplace({in, out}, 0);
    if (is_new) {
      entry->second = add_between(surface, in, out, value[in] / (value[in] - value[out]));
    }
    return entry->second;
  };
  std::vector<std::uint32_t> kept;
  for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
    std::vector<std::uint32_t> polygon;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t here = surface.indices[at + corner];
      const std::uint32_t next = surface.indices[at + (corner + 1) % 3];
      if (value[here] >= 0) polygon.push_back(here);
      if (value[here] >= 0 && value[next] < 0) polygon.push_back(border_on(here, next));
      if (value[here] < 0 && value[next] >= 0) polygon.push_back(border_on(next, here));
    }
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      kept.insert(kept.end(), {polygon[0], polygon[i], polygon[i + 1]});
    }
  }
  surface.indices = std::move(kept);
}

std::uint32_t add_turned(Surface& surface, std::uint32_t vertex) {
  const std::uint32_t turned = add_between(surface, vertex, vertex, 0);
  surface.normals[turned] = -surface.normals[turned];
  return turned;
}

void append(Mesh& mesh, const Mesh& more) {
  const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto first_index = static_cast<std::uint32_t>(mesh.indices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const std::uint32_t index : more.indices) mesh.indices.push_back(first_vertex + index);
  for (Part part : more.parts) {
    part.first_index += first_index;
    mesh.parts.push_back(part);
  }
}

void simplify(Surface& surface, std::size_t triangles, bool keep_borders) {
  if (3 * triangles >= surface.indices.size()) return;
  std::vector<std::uint32_t> indices(surface.indices.size());
  constexpr float kWorstError = 0.05F;  // relative to the surface's size
  indices.resize(meshopt_simplify(indices.data(), surface.indices.data(), surface.indices.size(),
                                  surface.positions.front().data(), surface.positions.size(),
                                  sizeof(Eigen::Vector3f), 3 * triangles, kWorstError,
                                  keep_borders ? meshopt_SimplifyLockBorder : 0, nullptr));
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
        vertex.position = to_array(surface.positions[index]);
        vertex.normal = to_array(surface.normals[index]);
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
