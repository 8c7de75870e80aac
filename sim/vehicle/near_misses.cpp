#include "sim/vehicle/near_misses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

namespace throng::sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kNearM = 1;
constexpr double kClearM = 2;
constexpr double kSoonS = 1.5;
constexpr double kNever = std::numeric_limits<double>::infinity();

// From the gaps aside and above: both below 0 where bodies overlap.
double combine_gaps(double aside_m, double above_m) {
  if (aside_m <= 0) return above_m;
  if (above_m <= 0) return aside_m;
  return std::hypot(aside_m, above_m);
}

struct Interval {
  double from;
  double to;
};

// When two discs of a distance `d` overlap that approach each other at `v`.
Interval discs_overlap(const Vector2d& d, const Vector2d& v, double radii_m) {
  const double a = v.squaredNorm();
  const double b = d.dot(v);
  const double c = d.squaredNorm() - radii_m * radii_m;
  if (a < 1e-12) return c <= 0 ? Interval{-kNever, kNever} : Interval{kNever, kNever};
  const double root2 = b * b - a * c;
  if (root2 < 0) return {kNever, kNever};
  const double root = std::sqrt(root2);
  return {(-b - root) / a, (-b + root) / a};
}

Interval spans_overlap(double d, double v, double half_m) {
  if (std::abs(v) < 1e-9) {
    return std::abs(d) <= half_m ? Interval{-kNever, kNever} : Interval{kNever, kNever};
  }
  const double one = (-half_m - d) / v;
  const double two = (half_m - d) / v;
  return {std::min(one, two), std::max(one, two)};
}

VehicleInAir person_as_vehicle(const NearPerson& person) {
  VehicleInAir body;
  body.position = {person.position.x(), person.position.y(), 0.5 * kPersonHeightM};
  body.velocity = {person.velocity.x(), person.velocity.y(), 0};
  body.radius_m = kPersonRadiusM;
  body.height_m = kPersonHeightM;
  return body;
}

}  // namespace

Approach nearest_approach(const VehicleInAir& a, const VehicleInAir& b) {
  const Vector3d d = b.position - a.position;
  const Vector3d v = b.velocity - a.velocity;
  const double radii_m = a.radius_m + b.radius_m;
  const double half_m = 0.5 * (a.height_m + b.height_m);
  const Interval aside = discs_overlap(d.head<2>(), v.head<2>(), radii_m);
  const Interval above = spans_overlap(d.z(), v.z(), half_m);
  const double from = std::max({0.0, aside.from, above.from});
  const bool meets = from <= std::min(aside.to, above.to);
  return {combine_gaps(d.head<2>().norm() - radii_m, std::abs(d.z()) - half_m),
          meets ? from : kNever};
}

Approach nearest_approach(const VehicleInAir& vehicle, const world::Building& building) {
  const auto gap_at = [&](const Vector3d& p) {
    return combine_gaps(geometry::distance_to(building.footprint, p.head<2>()) - vehicle.radius_m,
                        p.z() - 0.5 * vehicle.height_m - building.height_m);
  };
  Approach approach{gap_at(vehicle.position), kNever};
  if (approach.gap_m > vehicle.velocity.norm() * kSoonS) return approach;
  constexpr double kLookS = 0.1;
  for (double t = 0; t <= kSoonS; t += kLookS) {
    if (gap_at(vehicle.position + t * vehicle.velocity) > 0) continue;
    approach.contact_in_s = t;
    break;
  }
  return approach;
}

NearMisses::NearMisses(std::vector<world::Building> buildings, Log log)
    : buildings_(std::move(buildings)), log_(std::move(log)) {
  for (const world::Building& building : buildings_) {
    bounds_.push_back(geometry::bounding_box(building.footprint));
  }
}

double NearMisses::reach_m(const VehicleInAir& vehicle) {
  constexpr double kRunMps = 3;
  const double speed_mps = vehicle.velocity.norm() + kRunMps;
  const double above_m = vehicle.position.z() - kPersonHeightM;
  if (above_m > kClearM + std::max(0.0, -vehicle.velocity.z()) * kSoonS) return 0;
  return vehicle.radius_m + kPersonRadiusM + kClearM + speed_mps * kSoonS;
}

void NearMisses::update(double time_s, std::span<const VehicleInAir> vehicles,
                        std::span<const NearPerson> people) {
  for (auto& [key, entry] : cases_) entry.seen = false;
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    const VehicleInAir& vehicle = vehicles[i];
    for (std::size_t j = i + 1; j < vehicles.size(); ++j) {
      if (!vehicle.moves && !vehicles[j].moves) continue;
      look(time_s, {i, Obstacle::drone, static_cast<int>(j)},
           nearest_approach(vehicle, vehicles[j]));
    }
    if (!vehicle.moves) continue;
    if (reach_m(vehicle) > 0) {
      for (const NearPerson& person : people) {
        look(time_s, {i, Obstacle::person, person.agent},
             nearest_approach(vehicle, person_as_vehicle(person)));
      }
    }
    const double reach = vehicle.radius_m + kClearM + vehicle.velocity.norm() * kSoonS;
    const Vector2d place = vehicle.position.head<2>();
    for (std::size_t j = 0; j < buildings_.size(); ++j) {
      if (((place - bounds_[j].max).array() > reach).any() ||
          ((bounds_[j].min - place).array() > reach).any()) {
        continue;
      }
      look(time_s, {i, Obstacle::building, static_cast<int>(j)},
           nearest_approach(vehicle, buildings_[j]));
    }
  }
  for (auto entry = cases_.begin(); entry != cases_.end();) {
    if (entry->second.seen) {
      ++entry;
      continue;
    }
    write(entry->first, entry->second);
    entry = cases_.erase(entry);
  }
}

void NearMisses::look(double time_s, const Key& key, const Approach& approach) {
  const bool threatens = approach.contact_in_s < kSoonS;
  const auto found = cases_.find(key);
  if (found == cases_.end()) {
    if (approach.gap_m >= kNearM && !threatens) return;
    cases_[key] = {approach.gap_m, time_s, approach.contact_in_s, true, false};
    return;
  }
  Case& entry = found->second;
  entry.seen = approach.gap_m < kClearM || threatens;
  entry.contact_in_s = std::min(entry.contact_in_s, approach.contact_in_s);
  if (approach.gap_m < entry.gap_m) {
    entry.gap_m = approach.gap_m;
    entry.gap_time_s = time_s;
  }
}

void NearMisses::collided(std::size_t vehicle, Obstacle obstacle, int index) {
  // Two drones have one case, which is the first one's.
  const bool swapped = obstacle == Obstacle::drone && static_cast<std::size_t>(index) < vehicle;
  const Key key = swapped
                      ? Key{static_cast<std::size_t>(index), obstacle, static_cast<int>(vehicle)}
                      : Key{vehicle, obstacle, index};
  if (const auto found = cases_.find(key); found != cases_.end()) found->second.hit = true;
}

void NearMisses::finish() {
  for (const auto& [key, entry] : cases_) write(key, entry);
  cases_.clear();
}

void NearMisses::write(const Key& key, const Case& entry) {
  if (entry.hit) return;
  const auto [vehicle, obstacle, index] = key;
  world::NearMiss miss{static_cast<std::int32_t>(vehicle), obstacle, index,
                       std::max(0.0, entry.gap_m), std::nullopt};
  if (std::isfinite(entry.contact_in_s)) miss.contact_s = entry.contact_in_s;
  log_({entry.gap_time_s, miss});
}

}  // namespace throng::sim
