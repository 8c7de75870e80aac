#include "sim/guidance_loop.h"

#include "sim/recording/gimbal_setpoints.h"

namespace throng::sim {

namespace {

std::vector<std::optional<world::GoalRef>> list_goals(const std::vector<PlannedDrone>& drones) {
  std::vector<std::optional<world::GoalRef>> goals;
  goals.reserve(drones.size());
  for (const PlannedDrone& drone : drones) goals.push_back(drone.moves_goal);
  return goals;
}

// A vehicle that is so far below where it should be has come down, whatever its pilot thinks.
bool is_down(const Flight& flight, std::size_t drone) {
  constexpr double kDownM = 5;
  const double should_be_m = flight.pilot(drone).setpoint().position.z();
  return flight.state(drone).position.z() < should_be_m - kDownM;
}

bool leads(const Flight& flight, std::size_t drone) {
  const Pilot& pilot = flight.pilot(drone);
  return pilot.is_on_mission() && pilot.beacon() && !is_down(flight, drone);
}

}  // namespace

GuidanceLoop::GuidanceLoop(const world::Scenario& scenario,
                           const std::vector<world::AgentRole>& roles,
                           const std::vector<PlannedDrone>& drones, std::uint64_t seed,
                           double step_s)
    : drones_(drones), goals_(list_goals(drones)), observer_(scenario, roles, goals_, step_s) {
  for (std::size_t i = 0; i < drones.size(); ++i) {
    has_gimbal_.push_back(has_gimbal_setpoints(drones[i].mission.guidance.setpoints));
    const auto& perception = drones[i].mission.guidance.perception;
    cameras_.emplace_back();
    if (perception && perception->kind == PerceptionKind::camera) {
      cameras_.back().emplace(scenario, *perception, seed, i);
    }
  }
}

DroneSeen GuidanceLoop::seen(const Flight& flight, std::size_t drone) {
  const FlightState state = flight.state(drone);
  const Pilot& pilot = flight.pilot(drone);
  const LeadPlan plan = is_down(flight, drone) ? LeadPlan{} : pilot.policy().plan();
  return {state.position, state.velocity, leads(flight, drone), plan};
}

void GuidanceLoop::look(const CrowdSource& crowd, const CrowdRecorder& recorder, Flight& flight,
                        double time_s) {
  if (drones_.empty()) return;
  observer_.look(crowd, recorder, time_s);
  WorldView& view = observer_.view();
  view.drones.clear();
  for (std::size_t i = 0; i < drones_.size(); ++i) view.drones.push_back(seen(flight, i));
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    flight.pilot(i).policy().see(cameras_[i] ? cameras_[i]->estimate(view) : view);
    view.drones[i] = seen(flight, i);
  }
}

void GuidanceLoop::report(const Flight& flight, RunObserver& observer) const {
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    const Setpoint& setpoint = flight.pilot(i).setpoint();
    const double time_s = observer_.view().time_s;
    PilotSample sample{time_s, setpoint.position, setpoint.yaw_rad, leads(flight, i)};
    const DroneMission& mission = drones_[i].mission;
    if (has_gimbal_[i]) {
      sample.gimbal = gimbal_at(mission.guidance.setpoints, mission.camera.gimbal_angles(), time_s);
    }
    observer.pilot(i, sample);
  }
}

void GuidanceLoop::move_goals(const Flight& flight, CrowdSource& crowd) const {
  const Eigen::Vector2f out_of_sight(0, 5000);
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    if (!goals_[i]) continue;
    const Eigen::Vector2f below = flight.state(i).position.head<2>().cast<float>();
    crowd.move_goal(goals_[i]->set, goals_[i]->goal, leads(flight, i) ? below : out_of_sight);
  }
}

}  // namespace throng::sim
