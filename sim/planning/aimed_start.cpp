#include "sim/planning/aimed_start.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "sim/people/crowd_source.h"
#include "sim/people/load_people.h"
#include "sim/people/starting_people.h"
#include "sim/planning/clearance.h"

namespace throng::sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kTries = 200;
constexpr double kChestM = 1.2;
/// Starts of drones are farther apart, so that neither blows at the other.
constexpr double kMinApartM = 5;

/// A drone that looks at somebody.
struct View {
  Vector3d start;
  double yaw_rad = 0;  ///< heading
};

double ground_distance_m(const DroneMission& mission) {
  const double down_rad = -mission.camera.pitch_deg * kDegree;
  const double drop_m = mission.aim->height_m - kChestM;
  if (drop_m <= 0 || std::tan(down_rad) * mission.aim->max_distance_m <= drop_m) {
    return down_rad >= std::numbers::pi / 2 ? 0 : mission.aim->max_distance_m;
  }
  return drop_m / std::tan(down_rad);
}

Vector2d place_inside(const world::Scenario& scenario, Random& random) {
  const world::Rectangle& inside = scenario.inside.bounds;
  return {random.uniform(inside.min.x(), inside.max.x()),
          random.uniform(inside.min.y(), inside.max.y())};
}

class Aim {
 public:
  Aim(const world::Scenario& scenario, const std::vector<Vector2d>& people,
      const std::vector<Vector3d>& taken, const DroneMission& mission)
      : scenario_(scenario),
        people_(people),
        taken_(taken),
        mission_(mission),
        frame_(find_airframe(mission).value_or(Airframe{})) {}  // the plan reports unknown ones

  /// The first view with nothing in between, else the first from a free start.
  std::optional<View> view(Random random) const {
    std::optional<View> hidden;
    for (int i = 0; i < kTries; ++i) {
      const Vector2d target =
          people_.empty() ? place_inside(scenario_, random)
                          : people_[random.below(static_cast<std::uint32_t>(people_.size()))];
      const View candidate = view_of(target, random.uniform(0, 2 * std::numbers::pi));
      if (!is_free(candidate.start)) continue;
      const Vector3d chest(target.x(), target.y(), kChestM);
      if (building_between(scenario_, candidate.start, chest, frame_) == nullptr) return candidate;
      if (!hidden) hidden = candidate;
    }
    return hidden;
  }

 private:
  /// `yaw_rad` is that of the camera.
  View view_of(const Vector2d& target, double yaw_rad) const {
    const Vector2d ahead(std::cos(yaw_rad), std::sin(yaw_rad));
    const Vector2d place = target - ground_distance_m(mission_) * ahead;
    return {{place.x(), place.y(), mission_.aim->height_m},
            yaw_rad - mission_.camera.yaw_deg * kDegree};
  }

  bool is_free(const Vector3d& start) const {
    if (building_near(scenario_, start, frame_) != nullptr) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&](const Vector3d& other) {
      return (other - start).norm() < kMinApartM + 2 * frame_.radius_m();
    });
  }

  const world::Scenario& scenario_;
  const std::vector<Vector2d>& people_;
  const std::vector<Vector3d>& taken_;
  const DroneMission& mission_;
  Airframe frame_;
};

/// Starts that the scenario or the job gives.
std::vector<Vector3d> given_starts(const world::Scenario& scenario,
                                   const std::vector<DroneMission>& missions) {
  std::vector<Vector3d> starts;
  for (const DroneMission& mission : missions) {
    if (mission.aim) continue;
    if (mission.start) starts.push_back(*mission.start);
    for (const world::DroneStart& known : scenario.drones) {
      if (!mission.start && known.id == mission.id) starts.push_back(known.position);
    }
  }
  return starts;
}

bool has_aim(const DroneMission& mission) { return mission.aim.has_value(); }

}  // namespace

void aim_drones(const world::Scenario& scenario, const std::vector<Vector2d>& people,
                std::uint64_t seed, std::vector<DroneMission>& missions,
                std::vector<Problem>& problems) {
  if (std::none_of(missions.begin(), missions.end(), has_aim)) return;
  std::vector<Vector3d> taken = given_starts(scenario, missions);
  for (std::size_t i = 0; i < missions.size(); ++i) {
    DroneMission& mission = missions[i];
    if (!mission.aim) continue;
    const auto view = Aim(scenario, people, taken, mission).view(Random(seed, Stream::aim, i));
    if (!view) {
      problems.push_back({"", fmt::format("/drones/{}/aim", i),
                          fmt::format("a height of {:g} m, at which buildings or other drones are "
                                      "in the way wherever the drone might be",
                                      mission.aim->height_m),
                          "a greater height_m, another pitch_deg or a smaller max_distance_m"});
      continue;
    }
    mission.start = view->start;
    mission.start_yaw_rad = view->yaw_rad;
    mission.aim.reset();
    taken.push_back(view->start);
  }
}

bool has_aims(const RunSpec& run) {
  return std::any_of(run.drones.begin(), run.drones.end(), has_aim);
}

namespace {

std::vector<Vector2d> places_at_start(const world::Scenario& scenario, const RunSpec& run,
                                      std::span<const Eigen::Vector2f> positions,
                                      std::span<const std::uint8_t> present) {
  std::vector<Problem> of_people;  // the simulation reports them
  return places_of_persons(starting_roles(scenario, run, positions.size(), of_people), positions,
                           present);
}

}  // namespace

std::vector<Vector2d> people_to_aim_at(const world::Scenario& scenario, const RunSpec& run) {
  if (!has_aims(run)) return {};
  if (!run.recorded) {
    return people_to_aim_at(scenario, run, load_people(scenario, run.seed, run.crowd));
  }
  const auto source = replayed(run.recorded, run.seed);
  return places_at_start(scenario, run, source->positions(), source->present());
}

std::vector<Vector2d> people_to_aim_at(const world::Scenario& scenario, const RunSpec& run,
                                       const crowd::Simulation& people) {
  return places_at_start(scenario, run, people.positions(), people.present());
}

}  // namespace throng::sim
