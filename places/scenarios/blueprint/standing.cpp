#include "places/scenarios/blueprint/standing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "crowd/population/scatter.h"

namespace throng::scenarios {

using Eigen::Vector2d;

namespace {

constexpr std::uint32_t kClass = 1;
constexpr double kMinDistanceM = 0.36;  // between the middles of two people, in a crush
constexpr double kCalmM = 0.45;         // no nearer as long as there is room
constexpr double kMaxDistanceM = 1;     // nobody cares beyond

std::vector<Vector2d> prop_outline(const world::Prop& prop) {
  // Nothing thinner than this: a wall of no width is none.
  constexpr double kThinnestM = 0.1;
  const Vector2d half = (prop.scale * world::prop_type(prop.kind).half_size).cwiseMax(kThinnestM);
  const auto corners = geometry::turned_rectangle(prop.position, half, prop.yaw_rad);
  return {corners.begin(), corners.end()};
}

std::vector<Eigen::Vector2f> in_floats(std::span<const Vector2d> points) {
  std::vector<Eigen::Vector2f> floats;
  for (const Vector2d& point : points) floats.push_back(point.cast<float>());
  return floats;
}

}  // namespace

Solids::Solids(const world::Scenario& scenario) {
  for (const world::Building& building : scenario.buildings) {
    outlines_.push_back(building.footprint);
  }
  for (const world::Prop& prop : scenario.props) outlines_.push_back(prop_outline(prop));
  for (auto& part : world::open_water(scenario.areas)) outlines_.push_back(std::move(part));
  for (const auto& outline : outlines_) walls_.add_polygon(in_floats(outline), kClass);
  walls_.build();
}

bool Solids::is_clear(const Vector2d& point, double clearance_m) const {
  return walls_.is_clear(point.cast<float>(), static_cast<float>(clearance_m), kClass);
}

Standing stand(std::span<const Vector2d> area, int count, const Solids& solids, double clearance_m,
               std::vector<Vector2d>& taken) {
  constexpr double kCloser = 0.95;
  // Other seeds draw other positions: they get 15 % of the ground more than this one needs.
  constexpr double kSpare = 0.93;
  const std::vector<Eigen::Vector2f> others = in_floats(taken);
  const double own_m = std::sqrt(std::abs(geometry::signed_area(area)) / count);
  crowd::ScatterSpec spec;
  spec.area = in_floats(area);
  spec.count = static_cast<std::size_t>(count);
  spec.clearance_m = static_cast<float>(clearance_m);
  double apart_m = std::clamp(0.62 * own_m, kCalmM, kMaxDistanceM);
  std::vector<Eigen::Vector2f> positions;
  while (true) {
    spec.apart_m = static_cast<float>(apart_m);
    positions = crowd::scatter(spec, solids.walls(), others, Random(1, Stream::crowd_generator));
    if (positions.size() == spec.count || apart_m <= kMinDistanceM) break;
    apart_m = std::max(kMinDistanceM, kCloser * apart_m);
  }
  for (const Eigen::Vector2f& position : positions) taken.push_back(position.cast<double>());
  return {static_cast<int>(positions.size()), kSpare * apart_m};
}

}  // namespace throng::scenarios
