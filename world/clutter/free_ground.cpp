#include "world/clutter/free_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

namespace throng::world {

using Eigen::Vector2d;
using Eigen::Vector2i;

namespace {

constexpr double kGroundBucketM = 8;
constexpr double kApartM = 0.6;         // from other props
constexpr double kOffPeopleM = 1;       // from the inside of the scenario
constexpr double kBehindExitsM = 15;    // beyond the border of the scenario's inside
constexpr double kBesideExitsM = 2;     // on both sides of their way
constexpr double kOffCrossingsM = 2.5;  // so that drivers see who crosses

std::int64_t key(int x, int y) { return (std::int64_t{x} << 32) + y; }

std::array<Vector2d, 4> widened(const Prop& prop, double by_m) {
  const Vector2d half = prop.scale * prop_type(prop.kind).half_size + Vector2d::Constant(by_m);
  return geometry::turned_rectangle(prop.position, half, prop.yaw_rad);
}

/// The ground along a segment, this far on both sides of it.
std::array<Vector2d, 4> strip(const Vector2d& from, const Vector2d& to, double half_width_m) {
  const Vector2d along = (to - from).normalized();
  const Vector2d left = half_width_m * Vector2d(-along.y(), along.x());
  return {from - left, to - left, to + left, from + left};
}

}  // namespace

FreeGround::FreeGround(const Scenario& scenario) : scenario_(scenario) {
  for (const Building& building : scenario.buildings) add(building.footprint);
  for (const Exit& exit : scenario.exits) add_exit(exit);
  for (const Marking& marking : scenario.markings) {
    if (marking.kind == "crossing") {
      add(strip(marking.from, marking.to, 0.5 * marking.width_m + kOffCrossingsM));
    }
  }
  for (const Prop& prop : scenario.props) add(widened(prop, kApartM));
  for (std::uint32_t i = 0; i < scenario.areas.size(); ++i) {
    const auto [first, last] = buckets(scenario.areas[i].corners);
    for (int x = first.x(); x <= last.x(); ++x) {
      for (int y = first.y(); y <= last.y(); ++y) areas_in_[key(x, y)].push_back(i);
    }
  }
}

/// People come to an exit and go on straight behind it until they have left.
void FreeGround::add_exit(const Exit& exit) {
  const double reach_m = 0.5 * exit.length_m() + kBesideExitsM;
  Vector2d behind = exit.middle();
  while (scenario_.inside.contains(behind)) behind += exit.outward;
  behind += kBehindExitsM * exit.outward;
  add(strip(exit.middle() - kClearOfExitsM * exit.outward, behind, reach_m));
}

std::pair<Vector2i, Vector2i> FreeGround::buckets(std::span<const Vector2d> corners) const {
  const Rectangle box = geometry::bounding_box(corners);
  // Nothing is scattered beyond the ground.
  const Vector2d low = box.min.cwiseMax(scenario_.ground.min).cwiseMin(scenario_.ground.max);
  const Vector2d high = box.max.cwiseMin(scenario_.ground.max).cwiseMax(scenario_.ground.min);
  return {(low / kGroundBucketM).array().floor().cast<int>(),
          (high / kGroundBucketM).array().floor().cast<int>()};
}

void FreeGround::add(std::span<const Vector2d> corners) {
  const auto number = static_cast<std::uint32_t>(taken_.size());
  taken_.emplace_back(corners.begin(), corners.end());
  const auto [first, last] = buckets(corners);
  for (int x = first.x(); x <= last.x(); ++x) {
    for (int y = first.y(); y <= last.y(); ++y) taken_in_[key(x, y)].push_back(number);
  }
}

void FreeGround::take(const Prop& prop) { add(widened(prop, 0.1)); }

bool FreeGround::is_free(const Prop& prop) const {
  const auto corners = prop_footprint(prop);
  for (const Vector2d& corner : corners) {
    if (!scenario_.ground.contains(corner)) return false;
  }
  const auto [first, last] = buckets(corners);
  for (int x = first.x(); x <= last.x(); ++x) {
    for (int y = first.y(); y <= last.y(); ++y) {
      const auto found = taken_in_.find(key(x, y));
      if (found == taken_in_.end()) continue;
      for (const std::uint32_t i : found->second) {
        if (geometry::touch(taken_[i], corners)) return false;
      }
    }
  }
  // People who have left may still be near.
  return !geometry::touch(scenario_.inside.corners(), widened(prop, kOffPeopleM));
}

std::string_view FreeGround::material_at(const Vector2d& point) const {
  if (!scenario_.ground.contains(point)) return "";
  const Vector2i bucket = (point / kGroundBucketM).array().floor().cast<int>();
  const auto found = areas_in_.find(key(bucket.x(), bucket.y()));
  if (found != areas_in_.end()) {
    for (auto area = found->second.rbegin(); area != found->second.rend(); ++area) {
      if (geometry::distance_to(scenario_.areas[*area].corners, point) <= 0) {
        return scenario_.areas[*area].material;
      }
    }
  }
  return scenario_.ground_material;
}

}  // namespace throng::world
