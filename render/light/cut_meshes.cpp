#include "render/light/cut_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "render/light/near_map.h"
#include "render/light/refine.h"
#include "render/light/vertex.h"

namespace throng::render {

namespace {

using Eigen::Vector3f;

/// Drawing a triangle costs a software renderer some 0.1 us: these are a few milliseconds of a
/// frame.
constexpr std::size_t kMaxSceneryTriangles = 36'000;
constexpr std::size_t kMaxPropTriangles = 20'000;

/// Replaces the triangles of `range` in a new list of indices.
template <typename IsLong>
void cut_range(const std::vector<std::uint32_t>& indices, Range& range, SceneryMesh& mesh,
               std::vector<std::uint32_t>& out, const IsLong& is_long) {
  const std::vector<std::uint32_t> cut =
      refined(std::span(indices).subspan(range.first, range.count), mesh.vertices, is_long);
  range = {static_cast<std::uint32_t>(out.size()), static_cast<std::uint32_t>(cut.size())};
  out.insert(out.end(), cut.begin(), cut.end());
}

void cut_scenery(const NearMap& near, const Eigen::AlignedBox2d& ground, float scale,
                 SceneryMesh& mesh, std::vector<GroundLayer>& layers) {
  const Eigen::AlignedBox2f bounds = ground.cast<float>();
  // Light on the ground varies near what stands on it.
  const auto is_long = [&](const SceneryVertex& a, const SceneryVertex& b, float coarse) {
    const Vector3f edge = vertex_position(b) - vertex_position(a);
    const Vector3f middle = vertex_position(a) + 0.5F * edge;
    if (bounds.exteriorDistance(Eigen::Vector2f(middle.head<2>())) > 0) return false;
    const float wanted =
        std::clamp(0.8F + 0.45F * near.distance_m(middle.x(), middle.y()), 0.8F, 6.0F);
    return edge.norm() > coarse * scale * wanted;
  };
  const auto on_ground = [&](const SceneryVertex& a, const SceneryVertex& b) {
    return is_long(a, b, 1);
  };
  // Strips come in short pieces, and are so narrow that little light varies across them.
  const auto on_strip = [&](const SceneryVertex& a, const SceneryVertex& b) {
    return is_long(a, b, 2);
  };
  // On walls, from their foot upwards, more than along them.
  const auto on_wall = [&](const SceneryVertex& a, const SceneryVertex& b) {
    const Vector3f edge = vertex_position(b) - vertex_position(a);
    const float low = std::min(a.position[2], b.position[2]);
    const float up = std::clamp(0.8F + 0.5F * low, 0.8F, 6.0F);
    return std::max(std::abs(edge.z()) / up, edge.head<2>().norm() / 4.0F) > scale;
  };
  const auto on_roof = [&](const SceneryVertex& a, const SceneryVertex& b) {
    return (vertex_position(b) - vertex_position(a)).norm() > 5 * scale;
  };
  const std::vector<std::uint32_t> indices = std::move(mesh.indices);
  std::vector<std::uint32_t> out;
  cut_range(indices, mesh.walls, mesh, out, on_wall);
  cut_range(indices, mesh.roofs, mesh, out, on_roof);
  cut_range(indices, mesh.ground, mesh, out, on_ground);
  for (Range* whole : {&mesh.surroundings, &mesh.decals}) {
    cut_range(indices, *whole, mesh, out,
              [](const SceneryVertex&, const SceneryVertex&) { return false; });
  }
  for (GroundLayer& layer : layers) {
    if (is_strip(layer.material)) {
      cut_range(indices, layer.range, mesh, out, on_strip);
    } else {
      cut_range(indices, layer.range, mesh, out, on_ground);
    }
  }
  mesh.indices = std::move(out);
}

/// Cuts the props' triangles with sides above `side_m`; returns how many there are.
std::size_t cut_props(float side_m, std::vector<PlacedProp>& props) {
  std::size_t count = 0;
  for (PlacedProp& prop : props) {
    if (prop.is_backdrop) continue;
    PropMesh& mesh = prop.mesh;
    const std::span<const std::uint32_t> all(mesh.indices);
    const std::size_t far_count = std::min(mesh.far_indices, all.size());
    const auto refine = [&](std::span<const std::uint32_t> part) {
      return refined(part, mesh.vertices, [&](const PropVertex& a, const PropVertex& b) {
        return a.paint[3] != static_cast<std::uint8_t>(Finish::leaves) &&
               (vertex_position(b) - vertex_position(a)).norm() > side_m;
      });
    };
    std::vector<std::uint32_t> cut = refine(all.first(mesh.only_far));
    const std::vector<std::uint32_t> always =
        refine(all.subspan(mesh.only_far, far_count - mesh.only_far));
    mesh.only_far = cut.size();
    cut.insert(cut.end(), always.begin(), always.end());
    // Details are small enough.
    mesh.far_indices = cut.size();
    cut.insert(cut.end(), all.begin() + static_cast<std::ptrdiff_t>(far_count), all.end());
    mesh.indices = std::move(cut);
    count += mesh.indices.size() / 3;
  }
  return count;
}

std::size_t count_triangles(const std::vector<PlacedProp>& props) {
  std::size_t count = 0;
  for (const PlacedProp& prop : props) count += prop.is_backdrop ? 0 : prop.mesh.indices.size() / 3;
  return count;
}

}  // namespace

void cut_meshes(const Eigen::AlignedBox2d& ground, double scale, PlaceMeshes& meshes) {
  constexpr float kCoarser = 1.5F;
  const NearMap near(meshes, ground);
  const SceneryMesh scenery = meshes.scenery;
  const std::vector<GroundLayer> layers = meshes.layers;
  const std::size_t max_triangles =
      std::max(kMaxSceneryTriangles, scenery.indices.size() / 3 * 5 / 4) + scenery.decals.count / 3;
  for (auto side = static_cast<float>(scale);; side *= kCoarser) {
    cut_scenery(near, ground, side, meshes.scenery, meshes.layers);
    if (meshes.scenery.indices.size() / 3 <= max_triangles) break;
    meshes.scenery = scenery;
    meshes.layers = layers;
  }
  // The dense meshes of users are fine enough.
  const std::size_t uncut = count_triangles(meshes.props);
  if (uncut > 4 * kMaxPropTriangles) return;
  const std::vector<PlacedProp> props = meshes.props;
  const std::size_t max_prop_triangles = count_triangles(props) + kMaxPropTriangles;
  for (auto side = static_cast<float>(2 * scale);
       cut_props(side, meshes.props) > max_prop_triangles; side *= kCoarser) {
    meshes.props = props;
  }
}

}  // namespace throng::render
