#include "render/ground/ground_layers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/geometry/triangulate.h"
#include "render/ground/ground_builder.h"
#include "render/ground/ground_edges.h"
#include "render/ground/ground_heights.h"
#include "render/ground/ground_map.h"
#include "render/ground/pitch.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

/// How many areas lie below each area, one on top of the other, by their bounds: those that meet
/// need heights of their own.
std::vector<int> area_levels(const std::vector<world::GroundArea>& areas) {
  constexpr double kTouchM = 0.001;
  std::vector<Eigen::AlignedBox2d> bounds;
  std::vector<int> levels;
  for (const world::GroundArea& area : areas) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& corner : area.corners) box.extend(corner);
    int level = 0;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      const Eigen::AlignedBox2d common = box.intersection(bounds[i]);
      if (common.isEmpty() || common.sizes().minCoeff() < kTouchM) continue;
      level = std::max(level, levels[i] + 1);
    }
    bounds.push_back(box);
    levels.push_back(level);
  }
  return levels;
}

/// A path that leaves the scenario between two points, as a track which becomes narrow and winds.
/// Its corners are in the order of the street's.
std::vector<Polygon> winding_track(const Vector2d& first, const Vector2d& second,
                                   const Vector2d& away) {
  constexpr double kTrackM = 3;
  constexpr double kStepM = 26;
  constexpr int kSteps = 12;
  std::vector<Polygon> parts;
  Vector2d left = first;
  Vector2d right = second;
  Vector2d middle = 0.5 * (first + second);
  double heading = std::atan2(away.y(), away.x());
  for (int step = 0; step < kSteps; ++step) {
    const double wave = std::sin(0.05 * (middle.x() - 0.7 * middle.y()) + 0.9 * step);
    heading += step > 0 ? 0.28 * wave : 0;
    middle += kStepM * Vector2d(std::cos(heading), std::sin(heading));
    const double whole_m = (second - first).norm();
    const double width_m =
        step == 0 ? std::min(whole_m, 0.5 * (whole_m + kTrackM)) : std::min(whole_m, kTrackM);
    const Vector2d across = 0.5 * width_m * Vector2d(-std::sin(heading), std::cos(heading));
    parts.push_back({left, right, middle - across, middle + across});
    left = middle + across;
    right = middle - across;
  }
  return parts;
}

}  // namespace

bool is_strip(std::string_view material) {
  return material == "kerb" || material == "setts" || material == "gutter" || material == "tactile";
}

std::vector<Polygon> streets_beyond(const world::Scenario& scenario, std::size_t area) {
  constexpr double kSlackM = 0.05;
  constexpr double kReachM = 1500;
  constexpr double kMaxWidthM = 25;  // of a street
  const world::GroundArea& street = scenario.areas.at(area);
  std::vector<Polygon> parts;
  if (street.material == "grass" || street.material == "water") return parts;
  for (std::size_t i = 0; i < street.corners.size(); ++i) {
    const Vector2d& from = street.corners[i];
    const Vector2d& to = street.corners[(i + 1) % street.corners.size()];
    if ((to - from).norm() > kMaxWidthM) continue;
    for (int axis = 0; axis < 2; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        const double edge = side < 0 ? scenario.ground.min[axis] : scenario.ground.max[axis];
        if (side * (from[axis] - edge) < -kSlackM || side * (to[axis] - edge) < -kSlackM) continue;
        const Vector2d away = side * kReachM * Vector2d::Unit(axis);
        const bool is_left = geometry::cross(from - to, away) > 0;
        const Vector2d& first = is_left ? to : from;
        const Vector2d& second = is_left ? from : to;
        if (street.material == "asphalt") {
          parts.push_back({first, second, second + away, first + away});
        } else {
          for (Polygon& part : winding_track(first, second, away)) parts.push_back(std::move(part));
        }
      }
    }
  }
  return parts;
}

std::vector<GroundLayer> add_ground_layers(const world::Scenario& scenario, SceneryMesh& mesh) {
  GroundBuilder builder(mesh);
  const GroundMap map(scenario);
  std::vector<GroundLayer> layers;
  const auto layer = [&](const std::string& material, auto&& add) {
    const std::uint32_t first = builder.indices();
    add();
    if (builder.indices() > first) layers.push_back({material, {first, builder.indices() - first}});
  };
  const auto bands = [&](const std::string& material, const GroundCover& cover) {
    if (material != "pavers") return;
    layer("setts", [&] { add_bands(cover, scenario, map, builder); });
  };
  layer("paint", [&] { add_paint(scenario, map, builder); });
  layer("tactile", [&] { add_tactile_paving(scenario, map, builder); });
  layer("kerb", [&] { add_kerbs(scenario, map, builder); });
  layer("gutter", [&] { add_gutters(map, builder); });
  layer("grass", [&] { add_mown_stripes(scenario, builder); });
  const std::vector<int> levels = area_levels(scenario.areas);
  for (std::size_t i = scenario.areas.size(); i-- > 0;) {
    const world::GroundArea& area = scenario.areas[i];
    if (area.material == "water") continue;
    const double height_m = ground_height::kAreaM +
                            ground_height::kNextM * std::min(levels[i], ground_height::kMaxLevels);
    const std::vector<Polygon> holes = world::water_parts(scenario.areas, i);
    bands(area.material, {area.corners, holes, height_m});
    layer(area.material, [&] {
      builder.set_outline(area.corners);
      for (const auto& triangle : geometry::triangulate(area.corners)) {
        const Polygon whole = {area.corners[triangle[0]], area.corners[triangle[1]],
                               area.corners[triangle[2]]};
        for (const Polygon& part : world::without(whole, holes))
          builder.add_in_cells(part, height_m);
      }
      builder.set_outline({});
      for (const Polygon& part : streets_beyond(scenario, i)) builder.add(part, height_m);
    });
  }
  const auto& [low, high] = scenario.ground;
  bands(scenario.ground_material, {{low, {high.x(), low.y()}, high, {low.x(), high.y()}},
                                   world::water_parts(scenario.areas),
                                   0});
  return layers;
}

}  // namespace throng::render
