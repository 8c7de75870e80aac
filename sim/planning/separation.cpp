#include "sim/planning/separation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/planning/planned_motion.h"
#include "sim/vehicle/near_misses.h"

namespace throng::sim {

using Eigen::Vector3d;

namespace {

struct Box {
  Vector3d min = Vector3d::Constant(INFINITY);
  Vector3d max = Vector3d::Constant(-INFINITY);

  void add(const Vector3d& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  bool overlaps(const Box& other, double margin_m) const {
    return ((min - other.max).array() < margin_m).all() &&
           ((other.min - max).array() < margin_m).all();
  }
};

// All places that a drone can be asked to go to.
Box reach_box(const PlannedDrone& drone) {
  const GuidanceSpec& guidance = drone.mission.guidance;
  Box box;
  box.add(drone.start);
  for (const Vector3d& point : drone.mission.waypoints) box.add(point);
  for (const PilotSample& sample : guidance.setpoints) box.add(sample.position);
  const double height_m = drone.start.z();
  const bool keeps_place = drone.mission.policy == "hover" || !drone.mission.waypoints.empty() ||
                           !guidance.setpoints.empty();
  if (keeps_place) return box;
  // Circles and lanes may begin and end beyond the figure asked for: anywhere at that height.
  box.min = {-INFINITY, -INFINITY, height_m};
  box.max = {INFINITY, INFINITY, height_m};
  return box;
}

VehicleInAir inflated(const PlannedDrone& drone, const Vector3d& position) {
  VehicleInAir vehicle;
  vehicle.position = position;
  vehicle.radius_m = drone.airframe.radius_m() + 0.5 * kFlightClearanceM;
  vehicle.height_m = drone.airframe.height_m + kFlightClearanceM;
  return vehicle;
}

struct Meeting {
  double time_s;
  Vector3d place;
};

// When and where the second of two drones first comes too near to the first.
std::optional<Meeting> first_meeting(const PlannedDrone& one, const PlannedDrone& two,
                                     double duration_s) {
  VehicleInAir a = inflated(one, one.start);
  VehicleInAir b = inflated(two, two.start);
  if (nearest_approach(a, b).gap_m < 0) return Meeting{0, two.start};
  if (goes_by_people(*one.policy) || goes_by_people(*two.policy)) return std::nullopt;
  if (!reach_box(one).overlaps(reach_box(two), 2 + a.radius_m + b.radius_m)) return std::nullopt;
  constexpr double kStepS = 0.1;
  PlannedMotion first(one);
  PlannedMotion second(two);
  const int steps = static_cast<int>(std::ceil(duration_s / kStepS));
  for (int i = 0; i < steps; ++i) {
    const Vector3d from_a = a.position;
    const Vector3d from_b = b.position;
    const Vector3d to_a = first.advance(kStepS);
    const Vector3d to_b = second.advance(kStepS);
    a.velocity = (to_a - from_a) / kStepS;
    b.velocity = (to_b - from_b) / kStepS;
    const double in_s = nearest_approach(a, b).contact_in_s;
    if (in_s <= kStepS) return Meeting{i * kStepS + in_s, from_b + in_s * b.velocity};
    a.position = to_a;
    b.position = to_b;
  }
  return std::nullopt;
}

}  // namespace

void check_separation(const std::vector<PlannedDrone>& drones, double duration_s,
                      std::vector<Problem>& problems) {
  for (std::size_t i = 1; i < drones.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto meeting = first_meeting(drones[j], drones[i], duration_s);
      if (!meeting) continue;
      const bool at_start = meeting->time_s <= 0;
      const std::string position = fmt::format("[{:.4g}, {:.4g}, {:.4g}]", meeting->place.x(),
                                               meeting->place.y(), meeting->place.z());
      problems.push_back(
          {"", fmt::format("/drones/{}/{}", i, at_start ? "start" : "guidance"),
           at_start ? position
                    : fmt::format("a path that meets that of drone \"{}\" at {:.1f} s, near {}",
                                  drones[j].mission.id, meeting->time_s, position),
           fmt::format("{} at least {:g} m away from {} \"{}\"", at_start ? "a start" : "a path",
                       kFlightClearanceM, at_start ? "the start of drone" : "drone",
                       drones[j].mission.id)});
      break;
    }
  }
}

std::vector<Problem> possible_meetings(const std::vector<PlannedDrone>& drones) {
  std::vector<Problem> warnings;
  for (std::size_t i = 1; i < drones.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const PlannedDrone& one = drones[j];
      const PlannedDrone& two = drones[i];
      if (!goes_by_people(*one.policy) && !goes_by_people(*two.policy)) continue;
      const double room_m =
          0.5 * (one.airframe.height_m + two.airframe.height_m) + kFlightClearanceM;
      const Box a = reach_box(one);
      const Box b = reach_box(two);
      if (a.min.z() - b.max.z() >= room_m || b.min.z() - a.max.z() >= room_m) continue;
      warnings.push_back(
          {"", fmt::format("/drones/{}", i),
           fmt::format("a height at which drone \"{}\" may fly into this one", one.mission.id),
           fmt::format("heights that differ by at least {:.2g} m, since the policy \"{}\" goes "
                       "where people are",
                       room_m,
                       goes_by_people(*one.policy) ? one.mission.policy : two.mission.policy)});
      break;
    }
  }
  return warnings;
}

}  // namespace throng::sim
