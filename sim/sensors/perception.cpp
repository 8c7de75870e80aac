#include "sim/sensors/perception.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/compute/random.h"

namespace throng::sim {

using Eigen::Vector2d;

namespace {

constexpr double kFlowWindowS = 8;
constexpr double kDoorMarginM = 0.5;  // discs rub along the jambs

double beyond(const world::Exit& exit, const Vector2d& place) {
  return (place - exit.middle()).dot(exit.outward);
}

bool within_door(const world::Exit& exit, const Vector2d& place) {
  const Vector2d along = (exit.to - exit.from).normalized();
  return std::abs((place - exit.middle()).dot(along)) <= 0.5 * exit.length_m() + kDoorMarginM;
}

}  // namespace

CrowdObserver::CrowdObserver(const world::Scenario& scenario,
                             const std::vector<world::AgentRole>& roles,
                             const std::vector<std::optional<world::GoalRef>>& guide_goals,
                             double step_s)
    : scenario_(scenario),
      roles_(roles),
      guide_goals_(guide_goals),
      side_(scenario.exits.size(), std::vector<int>(roles.size(), -1)),
      left_(roles.size(), false),
      flow_steps_(static_cast<std::size_t>(std::lround(kFlowWindowS / step_s))),
      step_s_(step_s) {
  view_.exit_flow_per_s.resize(scenario.exits.size());
}

int CrowdObserver::guide_of(const crowd::GoalId& goal) const {
  const world::GoalRef ref{goal.set, goal.goal};
  const auto found = std::find(guide_goals_.begin(), guide_goals_.end(), ref);
  return found == guide_goals_.end() ? -1 : static_cast<int>(found - guide_goals_.begin());
}

void CrowdObserver::count_flows(std::size_t agent, const Vector2d& place, std::vector<int>& out) {
  for (std::size_t e = 0; e < scenario_.exits.size(); ++e) {
    const world::Exit& exit = scenario_.exits[e];
    const int side = beyond(exit, place) > 0 ? 1 : -1;
    if (side != side_[e][agent] && within_door(exit, place)) {
      left_[agent] = side > 0;
      if (side > 0) ++out[e];
    }
    side_[e][agent] = side;
  }
}

void CrowdObserver::look(const CrowdSource& crowd, const CrowdRecorder& recorder, double time_s) {
  view_.time_s = time_s;
  view_.people.clear();
  std::vector<int> out(scenario_.exits.size());
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    const bool is_there = crowd.on_ground()[i] != 0 && !recorder.escaped()[i];
    if (roles_[i] != world::AgentRole::person || !is_there || recorder.down()[i]) continue;
    PersonSeen person;
    person.position = crowd.positions()[i].cast<double>();
    person.velocity = crowd.velocities()[i].cast<double>();
    person.guide = guide_of(crowd.goals()[i]);
    person.exit = person.guide >= 0 ? -1 : recorder.intents()[i];
    count_flows(i, person.position, out);
    if (!left_[i] || person.guide >= 0) view_.people.push_back(person);
  }
  out_.push_back(std::move(out));
  if (out_.size() > flow_steps_) out_.pop_front();
  for (std::size_t e = 0; e < scenario_.exits.size(); ++e) {
    int count = 0;
    for (const std::vector<int>& step : out_) count += step[e];
    view_.exit_flow_per_s[e] = count / (static_cast<double>(out_.size()) * step_s_);
  }
}

CameraPerception::CameraPerception(const world::Scenario& scenario, const PerceptionSpec& spec,
                                   std::uint64_t seed, std::size_t drone)
    : scenario_(scenario), spec_(spec), seed_(seed), drone_(drone) {}

// Moving people are assumed to go to the exit most nearly ahead, standing people to the nearest.
void CameraPerception::guess(const WorldView& seen, PersonSeen& person) const {
  constexpr double kBeaconReachM = 6;
  constexpr double kStandsMps = 0.3;
  person.guide = -1;
  person.exit = -1;
  const DroneSeen& own = seen.drones[drone_];
  if (own.beacon && (person.position - own.position.head<2>()).norm() < kBeaconReachM) {
    person.guide = static_cast<int>(drone_);
    return;
  }
  const double speed = person.velocity.norm();
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < scenario_.exits.size(); ++e) {
    const Vector2d offset = scenario_.exits[e].middle() - person.position;
    const double ahead = speed < kStandsMps
                             ? 1
                             : offset.dot(person.velocity) / std::max(1e-9, offset.norm() * speed);
    const double cost = offset.norm() * (2 - ahead);
    if (cost < best) {
      best = cost;
      person.exit = static_cast<int>(e);
    }
  }
}

const WorldView& CameraPerception::estimate(const WorldView& truth) {
  past_.push_back(truth);
  while (past_.size() > 1 && past_[1].time_s <= truth.time_s - spec_.delay_s + world::kTimeSlackS) {
    past_.pop_front();
  }
  const WorldView& seen = past_.front();
  const DroneSeen& own = seen.drones[drone_];
  const double reach_m = own.position.z() * std::tan(0.5 * spec_.fov_rad);
  constexpr double kPlaceNoiseM = 0.3;
  Random random(derive_seed(seed_, Stream::perception, drone_), Stream::perception, looks_++);
  estimate_ = {truth.time_s, {}, seen.exit_flow_per_s, truth.drones};
  for (PersonSeen person : seen.people) {
    if ((person.position - own.position.head<2>()).norm() > reach_m) continue;
    const double fate = random.uniform();
    const int copies = fate < spec_.count_noise ? 0 : fate < 2 * spec_.count_noise ? 2 : 1;
    guess(seen, person);
    for (int copy = 0; copy < copies; ++copy) {
      PersonSeen found = person;
      found.position += Vector2d(random.normal(0, kPlaceNoiseM), random.normal(0, kPlaceNoiseM));
      estimate_.people.push_back(found);
    }
  }
  return estimate_;
}

}  // namespace throng::sim
