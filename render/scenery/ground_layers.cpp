#include "render/scenery/ground_layers.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/geometry/triangulate.h"
#include "render/frame/frame.h"
#include "render/scenery/ground_tone.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

constexpr double kAreaHeightM = 0.0006;
constexpr double kNextAreaM = 0.0001;
constexpr std::size_t kMaxHeights = 6;
constexpr double kKerbHeightM = 0.0014;
constexpr double kPaintHeightM = 0.0017;

/// The part of a convex polygon on the side of a line where normal . p <= limit.
Polygon cut(const Polygon& polygon, const Vector2d& normal, double limit) {
  return geometry::clipped(polygon, [&](const Vector2d& p) { return normal.dot(p) - limit; });
}

/// Sides of the cells that areas are cut into are at least this long.
constexpr double kMinCellM = 3;

class LayerBuilder {
 public:
  explicit LayerBuilder(SceneryMesh& mesh) : mesh_(mesh) {}

  std::uint32_t indices() const { return static_cast<std::uint32_t>(mesh_.indices.size()); }

  /// From now on vertices know how far they are from the outline of an area, if it is not narrow.
  void set_outline(std::span<const Vector2d> outline) {
    Eigen::AlignedBox2d bounds;
    for (const Vector2d& p : outline) bounds.extend(p);
    const bool is_wide = !outline.empty() && bounds.sizes().minCoeff() > 3 * kMinCellM;
    outline_ = is_wide ? outline : std::span<const Vector2d>();
  }

  /// A convex polygon, counter-clockwise.
  void add(Polygon polygon, double height_m) {
    if (polygon.size() < 3) return;
    // A fan around the innermost corner: no triangle has all of its corners on the outline.
    std::rotate(polygon.begin(),
                std::max_element(polygon.begin(), polygon.end(),
                                 [&](const Vector2d& a, const Vector2d& b) {
                                   return inside_m(a) + 1e-9 < inside_m(b);
                                 }),
                polygon.end());
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Vector2d& p : polygon) {
      mesh_.vertices.push_back(
          {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(height_m)},
           {0, 0, 1},
           {ground_tone_at(p), outline_.empty() ? 0 : static_cast<float>(1 + inside_m(p))},
           kIdGround,
           0,
           {}});
    }
    for (std::uint32_t i = 2; i < polygon.size(); ++i) {
      mesh_.indices.insert(mesh_.indices.end(), {first, first + i - 1, first + i});
    }
  }

  /// The same cut along a grid, so that vertices know how far they are from the outline.
  void add_in_cells(const Polygon& polygon, double height_m) {
    constexpr double kMaxCells = 48;
    Eigen::AlignedBox2d bounds;
    for (const Vector2d& p : polygon) bounds.extend(p);
    const double cell = std::max(kMinCellM, bounds.sizes().maxCoeff() / kMaxCells);
    for (double x = bounds.min().x(); x < bounds.max().x(); x += cell) {
      const Polygon column = cut(cut(polygon, {1, 0}, x + cell), {-1, 0}, -x);
      for (double y = bounds.min().y(); y < bounds.max().y(); y += cell) {
        add(cut(cut(column, {0, 1}, y + cell), {0, -1}, -y), height_m);
      }
    }
  }

  /// A strip from one point to another.
  void add_strip(const Vector2d& from, const Vector2d& to, double width_m, double height_m) {
    const Vector2d along = (to - from).normalized();
    const Vector2d across = 0.5 * width_m * Vector2d(-along.y(), along.x());
    add({from - across, to - across, to + across, from + across}, height_m);
  }

 private:
  double inside_m(const Vector2d& point) const {
    return outline_.empty() ? 0 : std::max(0.0, -geometry::signed_distance_to(outline_, point));
  }

  SceneryMesh& mesh_;
  std::span<const Vector2d> outline_;
};

void paint(const world::Marking& marking, LayerBuilder& layers) {
  const double length = (marking.to - marking.from).norm();
  const Vector2d along = (marking.to - marking.from) / length;
  if (marking.kind == "line") {
    layers.add_strip(marking.from, marking.to, marking.width_m, kPaintHeightM);
    return;
  }
  const double bar = marking.kind == "crossing" ? 0.5 : 2.0;
  for (double s = 0; s < length; s += 2 * bar) {
    const double end = std::min(s + bar, length);
    layers.add_strip(marking.from + s * along, marking.from + end * along, marking.width_m,
                     kPaintHeightM);
  }
}

void edge_with_kerb(const Polygon& corners, LayerBuilder& layers) {
  constexpr double kStoneM = 0.16;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& from = corners[i];
    const Vector2d& to = corners[(i + 1) % corners.size()];
    const Vector2d along = (to - from).normalized();
    const Vector2d inwards(-along.y(), along.x());
    layers.add({from, to, to + kStoneM * inwards, from + kStoneM * inwards}, kKerbHeightM);
  }
}

/// How many areas lie below each area, one on top of the other, by their bounds: those that meet
/// need heights of their own.
std::vector<std::size_t> area_levels(const std::vector<world::GroundArea>& areas) {
  constexpr double kTouchM = 0.001;
  std::vector<Eigen::AlignedBox2d> bounds;
  std::vector<std::size_t> levels;
  for (const world::GroundArea& area : areas) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& corner : area.corners) box.extend(corner);
    std::size_t level = 0;
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

std::vector<Polygon> streets_beyond(const world::Scenario& scenario, std::size_t area) {
  constexpr double kSlackM = 0.05;
  constexpr double kReachM = 1500;
  constexpr double kMaxWidthM = 25;  // of a street
  const world::GroundArea& street = scenario.areas.at(area);
  std::vector<Polygon> parts;
  if (street.material == "grass") return parts;
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
  LayerBuilder builder(mesh);
  std::vector<GroundLayer> layers;
  const auto layer = [&](const std::string& material, auto&& add) {
    const std::uint32_t first = builder.indices();
    add();
    if (builder.indices() > first) layers.push_back({material, {first, builder.indices() - first}});
  };
  layer("paint", [&] {
    for (const world::Marking& marking : scenario.markings) paint(marking, builder);
  });
  layer("kerb", [&] {
    for (const world::GroundArea& area : scenario.areas) {
      if (area.kerb) edge_with_kerb(area.corners, builder);
    }
  });
  const std::vector<std::size_t> levels = area_levels(scenario.areas);
  for (std::size_t i = scenario.areas.size(); i-- > 0;) {
    const world::GroundArea& area = scenario.areas[i];
    const double height_m =
        kAreaHeightM + kNextAreaM * static_cast<double>(std::min(levels[i], kMaxHeights));
    layer(area.material, [&] {
      builder.set_outline(area.corners);
      for (const auto& triangle : geometry::triangulate(area.corners)) {
        builder.add_in_cells(
            {area.corners[triangle[0]], area.corners[triangle[1]], area.corners[triangle[2]]},
            height_m);
      }
      builder.set_outline({});
      for (const Polygon& part : streets_beyond(scenario, i)) builder.add(part, height_m);
    });
  }
  return layers;
}

}  // namespace throng::render
