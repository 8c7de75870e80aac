#include "sim/planning/planned_paths.h"

#include "sim/planning/plan.h"
#include "sim/planning/planned_motion.h"

namespace throng::sim {

namespace {

world::DronePath path_of(const PlannedDrone& drone, double duration_s) {
  constexpr double kStepS = 0.05;
  world::DronePath path{drone.mission.id, {drone.start}};
  if (goes_by_people(*drone.policy)) return path;
  PlannedMotion motion(drone);
  const int steps = static_cast<int>(duration_s / kStepS);
  for (int i = 0; i < steps; ++i) path.add(motion.advance(kStepS));
  return path;
}

}  // namespace

std::vector<world::DronePath> planned_paths(const world::Scenario& scenario, const RunSpec& run) {
  std::vector<Problem> problems;
  const std::vector<PlannedDrone> drones =
      plan_drones(scenario, run.drones, run.duration_s, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  std::vector<world::DronePath> paths;
  paths.reserve(drones.size());
  for (const PlannedDrone& drone : drones) paths.push_back(path_of(drone, run.duration_s));
  return paths;
}

}  // namespace throng::sim
