#include "render/ground/ground_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "base/geometry/triangulate.h"
#include "render/ground/ground_heights.h"
#include "render/ground/pitch.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

constexpr double kKerbStoneM = 0.16;

/// Lays strips on an area whose outline may have any shape.
class Mosaic {
 public:
  Mosaic(const GroundCover& cover, GroundBuilder& builder) : builder_(builder) {
    const Polygon& corners = cover.corners;
    for (const auto& [a, b, c] : geometry::triangulate(corners)) {
      for (Polygon& part : world::without({corners[a], corners[b], corners[c]}, cover.holes)) {
        parts_.push_back(std::move(part));
      }
    }
  }

  /// The strip to the left of a segment, as far as it lies on the area.
  void add(const GroundSegment& segment, double width_m, double height_m) {
    const Vector2d far = width_m * segment.left();
    builder_.set_axes(segment);
    for (const auto& [from, to] : in_pieces(segment)) {
      for (const Polygon& part : parts_) {
        Polygon piece = {from, to, to + far, from + far};
        for (std::size_t i = 0; i < part.size(); ++i) {
          const GroundSegment side = {part[i], part[(i + 1) % part.size()]};
          piece = cut(piece, -side.left(), -side.left().dot(side.from));
        }
        builder_.add(piece, height_m);
      }
    }
  }

 private:
  std::vector<Polygon> parts_;
  GroundBuilder& builder_;
};

/// Bands in two directions, those across between those along, so that none lies on another.
void add_grid(const Polygon& corners, double height_m, Mosaic& mosaic) {
  constexpr double kMinAcrossM = 3;
  std::size_t longest = 0;
  const auto side = [&](std::size_t i) {
    return GroundSegment{corners[i], corners[(i + 1) % corners.size()]};
  };
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (side(i).length_m() > side(longest).length_m()) longest = i;
  }
  const Vector2d u = side(longest).along();
  const Vector2d v = side(longest).left();
  Eigen::AlignedBox2d bounds;
  for (const Vector2d& corner : corners) bounds.extend(Vector2d(corner.dot(u), corner.dot(v)));
  const Eigen::Array2d size = bounds.sizes();
  if (size.minCoeff() < kMinAcrossM) return;
  Random random(static_cast<std::uint64_t>(std::lround(10 * size.sum())), Stream::environment, 1);
  const double width_m = random.uniform(0.35, 0.6);
  const double spacing_m = random.uniform(8, 12);
  const Eigen::Array2d count = (size / spacing_m).round().max(1);
  const Eigen::Array2d step = (size - width_m) / count;
  const auto at = [&](double x, double y) {
    return Vector2d((bounds.min().x() + x) * u + (bounds.min().y() + y) * v);
  };
  for (double i = 0; i <= count.y(); ++i) {
    mosaic.add({at(0, i * step.y()), at(size.x(), i * step.y())}, width_m, height_m);
  }
  for (double i = 0; i <= count.x(); ++i) {
    for (double k = 0; k < count.y(); ++k) {
      const double x = i * step.x() + width_m;
      mosaic.add({at(x, k * step.y() + width_m), at(x, (k + 1) * step.y())}, width_m, height_m);
    }
  }
}

void add_bars(const world::Marking& marking, GroundBuilder& builder) {
  const GroundSegment whole = {marking.from, marking.to};
  const double length_m = whole.length_m();
  const double bar = marking.kind == "line" ? length_m : marking.kind == "crossing" ? 0.5 : 2.0;
  for (double s = 0; s < length_m; s += 2 * bar) {
    const double end = std::min(s + bar, length_m);
    builder.add_strip({marking.from + s * whole.along(), marking.from + end * whole.along()},
                      -0.5 * marking.width_m, 0.5 * marking.width_m, ground_height::kPaintM);
  }
}

/// Lines across the lanes that lead to a crossing; traffic keeps to the right.
void add_stop_lines(const world::Marking& crossing, GroundBuilder& builder) {
  constexpr double kLineM = 0.3;
  const double near_m = 0.5 * crossing.width_m + 1;
  const Vector2d middle = 0.5 * (crossing.from + crossing.to);
  builder.add_strip({crossing.from, middle}, near_m, near_m + kLineM, ground_height::kPaintM);
  builder.add_strip({middle, crossing.to}, -near_m - kLineM, -near_m, ground_height::kPaintM);
}

/// The ends of the parking bay around a car.
void add_bay(const world::Prop& car, GroundBuilder& builder) {
  constexpr double kFreeM = 0.5;
  constexpr double kLineM = 0.1;
  const auto corners = world::prop_footprint(car);
  for (const std::size_t end : {std::size_t{1}, std::size_t{3}}) {
    builder.add_strip({corners.at(end), corners.at((end + 1) % 4)}, -kFreeM - kLineM, -kFreeM,
                      ground_height::kPaintM);
  }
}

}  // namespace

void add_kerbs(const world::Scenario& scenario, const GroundMap& map, GroundBuilder& builder) {
  constexpr double kRaisedM = 0.05;
  for (const world::GroundArea& area : scenario.areas) {
    if (!is_bed(area)) continue;
    for (std::size_t i = 0; i < area.corners.size(); ++i) {
      const GroundSegment side = {area.corners[i], area.corners[(i + 1) % area.corners.size()]};
      const Vector2d inwards = kKerbStoneM * side.left();
      builder.add_strip(side, 0, kKerbStoneM, kRaisedM);
      builder.add_side(side, kRaisedM);
      builder.add_side({side.to + inwards, side.from + inwards}, kRaisedM);
    }
  }
  for (const GroundSegment& edge : map.road_edges()) {
    builder.add_strip(edge, 0, kKerbStoneM, ground_height::kKerbM);
  }
}

void add_gutters(const GroundMap& map, GroundBuilder& builder) {
  constexpr double kGutterM = 0.3;
  for (const GroundSegment& edge : map.road_edges()) {
    builder.add_strip(edge, kKerbStoneM, kKerbStoneM + kGutterM, ground_height::kGutterM);
  }
}

void add_bands(const GroundCover& cover, const world::Scenario& scenario, const GroundMap& map,
               GroundBuilder& builder) {
  constexpr double kWallStripM = 1.2;
  constexpr double kFreeM = 0.7;  // from any wall, at a corner that no other wall goes on from
  Mosaic mosaic(cover, builder);
  add_grid(cover.corners, cover.height_m + ground_height::kBandM, mosaic);
  for (const world::Building& building : scenario.buildings) {
    if (building.height_m < kMinStoryM || building.facade == world::Facade::hedge) continue;
    for (std::size_t i = 0; i < building.footprint.size(); ++i) {
      // Backwards: what lies outside is to the left.
      GroundSegment wall = {building.footprint[(i + 1) % building.footprint.size()],
                            building.footprint[i]};
      const Vector2d beyond = wall.to + 0.5 * kWallStripM * (wall.along() + wall.left());
      if (map.wall_m(beyond) > kFreeM) wall.to += kWallStripM * wall.along();
      mosaic.add(wall, kWallStripM, cover.height_m + ground_height::kWallStripM);
    }
  }
}

void add_tactile_paving(const world::Scenario& scenario, const GroundMap& map,
                        GroundBuilder& builder) {
  constexpr double kStepM = 0.1;
  constexpr double kMaxM = 2;
  constexpr double kBehindKerbM = 0.15;
  constexpr double kDepthM = 0.6;
  for (const world::Marking& marking : scenario.markings) {
    if (marking.kind != "crossing") continue;
    const GroundSegment whole = {marking.from, marking.to};
    for (const auto& [end, outward] : {std::pair{marking.from, Vector2d(-whole.along())},
                                       std::pair{marking.to, whole.along()}}) {
      double off_m = 0;
      while (off_m < kMaxM && !is_paved(map.material_at(end + off_m * outward))) off_m += kStepM;
      if (off_m >= kMaxM) continue;
      const Vector2d middle = end + (off_m + kBehindKerbM) * outward;
      const Vector2d half = 0.5 * marking.width_m * Vector2d(outward.y(), -outward.x());
      builder.add_strip({middle - half, middle + half}, 0, kDepthM, ground_height::kTactileM);
    }
  }
}

void add_paint(const world::Scenario& scenario, const GroundMap& map, GroundBuilder& builder) {
  for (const world::Marking& marking : scenario.markings) {
    if (marking.kind == "track") continue;
    if (marking.kind == "pitch") {
      add_pitch_lines(marking, builder);
      continue;
    }
    add_bars(marking, builder);
    const Vector2d middle = 0.5 * (marking.from + marking.to);
    const bool is_on_road = map.material_at(middle) == "asphalt";
    if (marking.kind == "crossing" && is_on_road) add_stop_lines(marking, builder);
  }
  for (const world::Prop& prop : scenario.props) {
    if (prop.kind != world::PropKind::car || map.material_at(prop.position) != "asphalt") continue;
    add_bay(prop, builder);
  }
}

}  // namespace throng::render
