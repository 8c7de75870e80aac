#include "sim/planning/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text/portable_name.h"
#include "base/text/suggest.h"
#include "base/text/words.h"
#include "sim/planning/clearance.h"
#include "sim/planning/guidance_check.h"
#include "sim/planning/separation.h"
#include "sim/policies/policy_table.h"

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kClearanceM = kFlightClearanceM;

std::string format_position(const Vector3d& p) {
  return fmt::format("[{:g}, {:g}, {:g}]", p.x(), p.y(), p.z());
}

// Checks one mission; every problem goes to the list with its pointer.
class MissionCheck {
 public:
  MissionCheck(const world::Scenario& scenario, const DroneMission& mission, std::size_t index,
               std::vector<Problem>& problems)
      : scenario_(scenario),
        mission_(mission),
        pointer_(fmt::format("/drones/{}", index)),
        problems_(problems) {
    const auto known = std::find_if(scenario.drones.begin(), scenario.drones.end(),
                                    [&](const auto& drone) { return drone.id == mission.id; });
    if (known != scenario.drones.end()) known_ = &*known;
  }

  PlannedDrone plan(const std::vector<Airframe>& airframes) {
    PlannedDrone drone;
    drone.mission = mission_;
    drone.airframe = airframe_from(airframes);
    drone.policy = policy();
    drone.start = start();
    drone.yaw_rad = mission_.start_yaw_rad.value_or(known_ != nullptr ? known_->yaw_rad : 0);
    drone.moves_goal = mission_.moves_goal;
    if (!drone.moves_goal && known_ != nullptr) drone.moves_goal = known_->moves_goal;
    if (drone.airframe.mass_kg > 0) {
      check_speed(drone.airframe);
      check_battery(drone.airframe);
      if (point_is_free("/start", drone.start, drone.airframe)) {
        check_path(drone);
        check_setpoints(drone);
        if (drone.policy != nullptr && drone.policy->flies_free) check_height(drone);
      }
    }
    return drone;
  }

 private:
  void add(const std::string& where, std::string found, std::string expected) {
    problems_.push_back({"", pointer_ + where, std::move(found), std::move(expected)});
  }

  Airframe airframe_from(const std::vector<Airframe>& airframes) {
    if (mission_.own_airframe) return *mission_.own_airframe;
    std::vector<std::string_view> names;
    for (const Airframe& frame : airframes) {
      if (frame.name == mission_.airframe) return frame;
      names.push_back(frame.name);
    }
    problems_.push_back(
        unknown_name("", pointer_ + "/airframe", "airframe", mission_.airframe, names));
    return {};
  }

  const PolicyEntry* policy() {
    const PolicyEntry* entry = find_policy(mission_.policy);
    if (entry == nullptr) {
      std::vector<std::string_view> names;
      for (const PolicyEntry& known : policies()) names.push_back(known.name);
      problems_.push_back(
          unknown_name("", pointer_ + "/guidance/policy", "policy", mission_.policy, names));
    } else {
      check_guidance(*entry, mission_, scenario_, pointer_ + "/guidance", problems_);
    }
    return entry;
  }

  Vector3d start() {
    if (mission_.aim) return Vector3d::Constant(NAN);  // no start was found, which is reported
    if (mission_.start) return *mission_.start;
    if (known_ != nullptr) return known_->position;
    add("/start", "none",
        fmt::format("a start, since the scenario has none for a drone \"{}\"", mission_.id));
    return Vector3d::Constant(NAN);
  }

  void check_speed(const Airframe& frame) {
    const double top_mps = std::floor(10 * frame.top_speed_mps()) / 10;
    if (mission_.speed_mps > 0 && mission_.speed_mps <= top_mps) return;
    add("/guidance/speed_mps", fmt::format("{:g}", mission_.speed_mps),
        fmt::format("more than 0 and at most {:g}, the top speed of the airframe \"{}\"", top_mps,
                    frame.name));
  }

  void check_battery(const Airframe& frame) {
    if (!mission_.battery_charge) return;
    if (!(*mission_.battery_charge > 0 && *mission_.battery_charge <= 1)) {
      add("/battery/charge", fmt::format("{:g}", *mission_.battery_charge),
          "more than 0 and at most 1");
    } else if (frame.battery_wh <= 0) {
      add("/battery/charge", "a charge",
          fmt::format("none, or a battery_wh in the airframe \"{}\"", frame.name));
    }
  }

  // Whether a vehicle can be at `point`. Reports no error for an unknown airframe.
  bool point_is_free(const std::string& where, const Vector3d& point, const Airframe& frame) {
    if (!point.allFinite()) {
      if (!mission_.aim && (mission_.start || known_ != nullptr))
        add(where, "not a number", "[x, y, z]");
      return false;
    }
    const double lowest_m = lowest_height_m(frame);
    if (point.z() < lowest_m) {
      add(where, format_position(point),
          fmt::format("a point at least {:.2g} m above the ground", lowest_m));
      return false;
    }
    if (const world::Building* building = building_near(scenario_, point, frame)) {
      add(where, format_position(point), away_from(*building, frame));
      return false;
    }
    return true;
  }

  static std::string away_from(const world::Building& building, const Airframe& frame) {
    return fmt::format("a point at least {:.2g} m away from building \"{}\", which is {:g} m high",
                       frame.radius_m() + kClearanceM, building.id, building.height_m);
  }

  void check_path(const PlannedDrone& drone) {
    Vector3d from = drone.start;
    for (std::size_t i = 0; i < mission_.waypoints.size(); ++i) {
      const Vector3d& to = mission_.waypoints[i];
      const std::string where = fmt::format("/guidance/waypoints/{}", i);
      if (!point_is_free(where, to, drone.airframe)) return;
      check_leg(where, from, to, drone.airframe);
      from = to;
    }
  }

  void check_setpoints(const PlannedDrone& drone) {
    const std::vector<PilotSample>& samples = mission_.guidance.setpoints;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::string where = fmt::format("/guidance/setpoints/{}", i);
      if (!point_is_free(where, samples[i].position, drone.airframe)) return;
      const Vector3d& from = i > 0 ? samples[i - 1].position : drone.start;
      if (!check_leg(where, from, samples[i].position, drone.airframe)) return;
    }
  }

  void check_height(const PlannedDrone& drone) {
    const auto tallest = std::max_element(
        scenario_.buildings.begin(), scenario_.buildings.end(),
        [](const world::Building& a, const world::Building& b) { return a.height_m < b.height_m; });
    if (tallest == scenario_.buildings.end() ||
        drone.start.z() >= tallest->height_m + kClearanceM) {
      return;
    }
    add("/start", format_position(drone.start),
        fmt::format("a height of at least {:g} m, above building \"{}\", the tallest with "
                    "{:g} m, since the policy \"{}\" keeps the height and flies everywhere",
                    tallest->height_m + kClearanceM, tallest->id, tallest->height_m,
                    drone.policy->name));
  }

  bool check_leg(const std::string& where, const Vector3d& from, const Vector3d& to,
                 const Airframe& frame) {
    const world::Building* building = building_between(scenario_, from, to, frame);
    if (building == nullptr) return true;
    add(where, fmt::format("a path from {} to {}", format_position(from), format_position(to)),
        fmt::format("a path at least {:.2g} m away from building \"{}\", which is {:g} m high",
                    frame.radius_m() + kClearanceM, building->id, building->height_m));
    return false;
  }

  const world::Scenario& scenario_;
  const DroneMission& mission_;
  std::string pointer_;
  std::vector<Problem>& problems_;
  const world::DroneStart* known_ = nullptr;
};

/// Ids are names of the dataset's folders, which is brought to other systems. Returns false for a
/// wrong one.
bool check_id(const std::vector<DroneMission>& missions, std::size_t i,
              std::vector<Problem>& problems) {
  const std::string& id = missions[i].id;
  const auto refuse = [&](std::string found, const char* expected) {
    problems.push_back({"", fmt::format("/drones/{}/id", i), std::move(found), expected});
    return false;
  };
  if (is_device_name(id)) {
    return refuse(fmt::format("\"{}\", a device of Windows", id),
                  "an id that can be a folder's name on Windows");
  }
  for (std::size_t j = 0; j < i; ++j) {
    const std::string& other = missions[j].id;
    if (other == id)
      return refuse(fmt::format("\"{}\" again", id), "an id that no other drone has");
    if (lower_case(other) != lower_case(id)) continue;
    return refuse(fmt::format("\"{}\" and \"{}\", one folder on Windows and macOS", other, id),
                  "ids that differ in more than their case");
  }
  return true;
}

}  // namespace

std::vector<PlannedDrone> plan_drones(const world::Scenario& scenario,
                                      const std::vector<DroneMission>& missions, double duration_s,
                                      std::vector<Problem>& problems) {
  const std::vector<Airframe> airframes = shipped_airframes();
  const std::size_t before = problems.size();
  std::vector<PlannedDrone> drones;
  for (std::size_t i = 0; i < missions.size(); ++i) {
    drones.push_back(MissionCheck(scenario, missions[i], i, problems).plan(airframes));
    drones[i].scenario = &scenario;
    drones[i].index = static_cast<int>(i);
    const bool has_good_id = check_id(missions, i, problems);
    for (std::size_t j = 0; j < i && has_good_id; ++j) {
      if (drones[i].moves_goal && drones[j].moves_goal == drones[i].moves_goal) {
        problems.push_back({"", fmt::format("/drones/{}/moves_goal", i),
                            fmt::format("the goal that drone \"{}\" moves", missions[j].id),
                            "a goal that no other drone moves"});
        break;
      }
    }
  }
  // Paths mean something only where each drone can fly its own.
  if (problems.size() == before) check_separation(drones, duration_s, problems);
  return drones;
}

}  // namespace throng::sim
