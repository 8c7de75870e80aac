#include "sim/stepped_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "base/error.h"
#include "sim/fleet/flight.h"
#include "sim/guidance_loop.h"
#include "sim/people/crowd_source.h"
#include "sim/people/load_people.h"
#include "sim/people/prop_watch.h"
#include "sim/people/starting_people.h"
#include "sim/planning/aimed_start.h"
#include "sim/planning/moved_goals.h"
#include "sim/planning/plan.h"
#include "sim/planning/separation.h"
#include "sim/recording/crowd_recorder.h"
#include "sim/vehicle/hold_warnings.h"

namespace throng::sim {

namespace {

constexpr double kMaxPhysicsStepS = 1.0 / 240;
constexpr double kMaxRunS = 86'400;

void check_times(const RunSpec& spec, std::vector<Problem>& problems) {
  if (!(spec.duration_s > 0 && spec.duration_s <= kMaxRunS)) {
    problems.push_back({"", "/capture/to_s", fmt::format("{:g}", spec.duration_s),
                        fmt::format("more than 0 and at most {:g} s", kMaxRunS)});
  }
  if (!(spec.physics_dt_s > 0 && spec.physics_dt_s <= kMaxPhysicsStepS + 1e-12)) {
    problems.push_back({"", "/physics_dt_s", fmt::format("{:g}", spec.physics_dt_s),
                        "more than 0 and at most 1/240 s"});
  }
}

void check_exits(const world::Scenario& scenario, std::vector<Problem>& problems) {
  constexpr std::size_t kMaxExits = std::numeric_limits<std::int8_t>::max();
  if (scenario.exits.size() > kMaxExits) {
    problems.push_back({scenario.id, "/exits", fmt::format("{} exits", scenario.exits.size()),
                        fmt::format("at most {}", kMaxExits)});
  }
}

// A first move of every goal, to learn whether the behavior file has it.
void check_goals(const world::Scenario& scenario, const std::vector<PlannedDrone>& drones,
                 CrowdSource& crowd, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < drones.size(); ++i) {
    if (!drones[i].moves_goal) continue;
    const auto [set, goal] = *drones[i].moves_goal;
    try {
      crowd.move_goal(set, goal, drones[i].start.head<2>().cast<float>());
    } catch (const InputError&) {
      problems.push_back(unknown_goal(i, *drones[i].moves_goal, scenario));
    }
  }
}

// A goal that a job, not its scenario, lets a drone move although nobody can ever follow the drone.
std::vector<Problem> idle_goals(const std::vector<PlannedDrone>& drones) {
  std::vector<Problem> warnings;
  for (std::size_t i = 0; i < drones.size(); ++i) {
    const DroneMission& mission = drones[i].mission;
    if (!has_own_goal(mission, *drones[i].scenario)) continue;
    if (guides(*drones[i].policy) || mission.guidance.beacon) continue;
    warnings.push_back({"", fmt::format("/drones/{}/moves_goal", i),
                        fmt::format("a goal, but the policy \"{}\" keeps the beacon off, so nobody "
                                    "follows this drone",
                                    mission.policy),
                        "\"beacon\": true in the drone's guidance, or no moves_goal"});
  }
  return warnings;
}

std::vector<world::GoalRef> goals_moved_by(const std::vector<PlannedDrone>& drones) {
  std::vector<world::GoalRef> goals;
  for (const PlannedDrone& drone : drones) {
    if (drone.moves_goal) goals.push_back(*drone.moves_goal);
  }
  return goals;
}

// People who are present; fills and returns `there`.
std::span<const std::uint8_t> people_there(const CrowdSource& crowd,
                                           const std::vector<world::AgentRole>& roles,
                                           std::vector<std::uint8_t>& there) {
  const auto present = crowd.on_ground();
  there.resize(roles.size());
  for (std::size_t i = 0; i < roles.size(); ++i) {
    there[i] = roles[i] == world::AgentRole::person ? present[i] : std::uint8_t{0};
  }
  return there;
}

void report_falls(const CrowdSource& crowd, double time_s, RunObserver& observer) {
  for (const crowd::Fall& fall : crowd.falls()) {
    observer.event(
        {time_s, world::PersonFall{static_cast<std::int32_t>(fall.agent), fall.impulse_ns > 0,
                                   fall.impulse_ns, fall.crush_n_per_m}});
  }
}

// Doors that have been reached by a disaster since the step before.
void report_closed_doors(const world::Scenario& scenario, double before_s, double time_s,
                         RunObserver& observer) {
  for (std::size_t e = 0; e < scenario.exits.size(); ++e) {
    const world::Exit& exit = scenario.exits[e];
    if (!exit.is_open(before_s) || exit.is_open(time_s)) continue;
    observer.event({time_s, world::ExitClosed{static_cast<std::int32_t>(e)}});
  }
}

world::TraceHeader make_header(const world::Scenario& scenario, const RunSpec& spec,
                               const CrowdSource& crowd,
                               const std::vector<world::AgentRole>& roles) {
  world::TraceHeader header = crowd.header(spec.seed);
  header.scenario_id = scenario.id;
  header.scenario_document = scenario.document;
  header.alarm = world::find_alarm(scenario);
  if (crowd.has_intents()) {
    for (const world::Exit& exit : scenario.exits) header.exit_ids.push_back(exit.id);
  }
  for (const DroneMission& mission : spec.drones) header.drone_ids.push_back(mission.id);
  header.role = roles;
  return header;
}

std::vector<Problem> run_warnings(const world::Scenario& scenario, const CrowdSource& crowd,
                                  const std::vector<PlannedDrone>& drones, const HoldWarnings& hold,
                                  const PropWatch& props) {
  // Authors of blueprints do not know the elements of a crowd; scenarios::check() speaks to them.
  std::vector<Problem> warnings = scenario.built_crowd ? std::vector<Problem>() : crowd.warnings();
  for (auto& warning : idle_goals(drones)) warnings.push_back(std::move(warning));
  for (auto& warning : possible_meetings(drones)) warnings.push_back(std::move(warning));
  warnings.insert(warnings.end(), hold.warnings().begin(), hold.warnings().end());
  warnings.insert(warnings.end(), props.problems().begin(), props.problems().end());
  return warnings;
}

// Everything that has to be in order before a run begins.
struct Checked {
  std::vector<PlannedDrone> drones;
  std::unique_ptr<CrowdSource> crowd;
  std::vector<world::AgentRole> roles;
};

Checked checked(const world::Scenario& scenario, const RunSpec& spec,
                std::optional<crowd::Simulation> loaded, std::vector<Problem>& problems) {
  check_times(spec, problems);
  check_exits(scenario, problems);
  Checked run;
  std::vector<Problem> of_people;
  StartingPeople people = starting_people(scenario, spec, of_people, std::move(loaded));
  std::vector<DroneMission> missions = spec.drones;
  if (has_aims(spec)) {
    const auto places =
        places_of_persons(people.roles, people.crowd->positions(), people.crowd->on_ground());
    aim_drones(scenario, places, spec.seed, missions, problems);
  }
  run.drones = plan_drones(scenario, missions, spec.duration_s, problems);
  problems.insert(problems.end(), of_people.begin(), of_people.end());
  run.crowd = std::move(people.crowd);
  run.roles = std::move(people.roles);
  check_goals(scenario, run.drones, *run.crowd, problems);
  return run;
}

}  // namespace

struct SteppedRun::State {
  State(const world::Scenario& where, const RunSpec& spec, RunObserver& receiver, Checked checked,
        PropWatch watch)
      : scenario(where),
        observer(receiver),
        drones(std::move(checked.drones)),
        source(std::move(checked.crowd)),
        roles(std::move(checked.roles)),
        crowd(*source),
        flight(scenario.buildings, drones, crowd.dt_s(), spec.physics_dt_s, log(),
               {spec.wind, spec.seed}),
        moving_goals(goals_moved_by(drones)),
        recorder(scenario, roles, moving_goals, spec.seed),
        guidance(scenario, roles, drones, spec.seed, crowd.dt_s()),
        props(std::move(watch)) {}

  FlightLog log() {
    return {[this](std::size_t drone, const world::DroneSample& sample) {
              observer.drone(drone, sample);
            },
            [this](const world::TraceEvent& event) {
              observer.event(event);
              hold.record(event);
            },
            [this](std::size_t agent, const Eigen::Vector2d& impulse_ns) {
              crowd.strike(agent, impulse_ns.cast<float>());
            }};
  }

  double step_time_s(long number) const { return static_cast<double>(number) * crowd.dt_s(); }

  // In the order in which each uses those above it.
  const world::Scenario& scenario;
  RunObserver& observer;
  HoldWarnings hold;
  std::vector<PlannedDrone> drones;
  std::unique_ptr<CrowdSource> source;
  std::vector<world::AgentRole> roles;
  CrowdSource& crowd;
  Flight flight;
  std::vector<world::GoalRef> moving_goals;
  CrowdRecorder recorder;
  GuidanceLoop guidance;
  PropWatch props;
  std::vector<std::uint8_t> there;
  long steps = 0;  ///< that are done
};

SteppedRun::SteppedRun(const world::Scenario& scenario, const RunSpec& spec, RunObserver& observer,
                       std::optional<crowd::Simulation> people) {
  std::vector<Problem> problems;
  Checked run = checked(scenario, spec, std::move(people), problems);
  std::vector<std::uint8_t> there;
  PropWatch props(scenario);
  props.look(run.crowd->positions(), people_there(*run.crowd, run.roles, there), 0);
  problems.insert(problems.end(), props.problems().begin(), props.problems().end());
  if (!problems.empty()) throw InputError(std::move(problems));
  observer.begin(make_header(scenario, spec, *run.crowd, run.roles));
  state_ = std::make_unique<State>(scenario, spec, observer, std::move(run), std::move(props));
  state_->recorder.record(state_->crowd, 0, observer);
}

SteppedRun::~SteppedRun() = default;

double SteppedRun::dt_s() const { return state_->crowd.dt_s(); }

double SteppedRun::time_s() const { return state_->step_time_s(state_->steps); }

const std::vector<PlannedDrone>& SteppedRun::drones() const { return state_->drones; }

FlightState SteppedRun::drone_state(std::size_t drone) const { return state_->flight.state(drone); }

const Pilot& SteppedRun::pilot(std::size_t drone) const { return state_->flight.pilot(drone); }

void SteppedRun::fly_on(std::size_t drone, const PilotSample& setpoint) {
  state_->flight.pilot(drone).policy().fly_on(setpoint);
}

void SteppedRun::step() {
  State& s = *state_;
  const double before_s = s.step_time_s(s.steps);
  s.guidance.look(s.crowd, s.recorder, s.flight, before_s);
  s.guidance.report(s.flight, s.observer);
  s.guidance.move_goals(s.flight, s.crowd);
  s.crowd.step();
  s.flight.advance({s.crowd.positions(), people_there(s.crowd, s.roles, s.there)});
  const double time_s = s.step_time_s(++s.steps);
  s.props.look(s.crowd.positions(), s.there, time_s);
  s.recorder.record(s.crowd, time_s, s.observer);
  report_falls(s.crowd, time_s, s.observer);
  report_closed_doors(s.scenario, before_s, time_s, s.observer);
}

std::vector<Problem> SteppedRun::finish() {
  state_->flight.finish();
  return run_warnings(state_->scenario, state_->crowd, state_->drones, state_->hold, state_->props);
}

}  // namespace throng::sim
