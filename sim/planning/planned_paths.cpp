#include "sim/planning/planned_paths.h"

#include "sim/planning/aimed_start.h"
#include "sim/planning/plan.h"
#include "sim/planning/planned_motion.h"

namespace throng::sim {

namespace {

constexpr double kPathStepS = 0.05;

world::DronePath plan_path(const PlannedDrone& drone, double duration_s) {
  world::DronePath path{drone.mission.id, {drone.start}};
  if (goes_by_people(*drone.policy)) return path;
  PlannedMotion motion(drone);
  const int steps = static_cast<int>(duration_s / kPathStepS);
  for (int i = 0; i < steps; ++i) path.add(motion.advance(kPathStepS));
  return path;
}

std::vector<PlannedPose> plan_poses(const PlannedDrone& drone, std::span<const double> times_s) {
  std::vector<PlannedPose> poses;
  if (goes_by_people(*drone.policy)) return poses;
  PlannedMotion motion(drone);
  PlannedPose pose{drone.start, drone.yaw_rad};
  int step = 0;
  for (const double time_s : times_s) {
    for (; step * kPathStepS < time_s; ++step)
      pose = {motion.advance(kPathStepS), motion.yaw_rad()};
    poses.push_back(pose);
  }
  return poses;
}

std::vector<PlannedDrone> checked_drones(const world::Scenario& scenario, const RunSpec& run,
                                         const std::vector<Eigen::Vector2d>& people) {
  std::vector<Problem> problems;
  std::vector<DroneMission> missions = run.drones;
  aim_drones(scenario, people, run.seed, missions, problems);
  std::vector<PlannedDrone> drones = plan_drones(scenario, missions, run.duration_s, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return drones;
}

}  // namespace

std::vector<world::DronePath> planned_paths(const world::Scenario& scenario, const RunSpec& run,
                                            const std::vector<Eigen::Vector2d>& people) {
  const std::vector<PlannedDrone> drones = checked_drones(scenario, run, people);
  std::vector<world::DronePath> paths;
  paths.reserve(drones.size());
  for (const PlannedDrone& drone : drones) paths.push_back(plan_path(drone, run.duration_s));
  return paths;
}

std::vector<world::DronePath> planned_paths(const world::Scenario& scenario, const RunSpec& run) {
  return planned_paths(scenario, run, people_to_aim_at(scenario, run));
}

std::vector<std::vector<PlannedPose>> planned_poses(const world::Scenario& scenario,
                                                    const RunSpec& run,
                                                    const std::vector<Eigen::Vector2d>& people,
                                                    std::span<const double> times_s) {
  std::vector<std::vector<PlannedPose>> poses;
  for (const PlannedDrone& drone : checked_drones(scenario, run, people)) {
    poses.push_back(plan_poses(drone, times_s));
  }
  return poses;
}

}  // namespace throng::sim
