#include "sim/run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "crowd/simulation.h"
#include "sim/guidance_loop.h"
#include "sim/people/crowd_source.h"
#include "sim/people/participants.h"
#include "sim/people/prop_watch.h"
#include "sim/planning/plan.h"
#include "sim/planning/separation.h"
#include "sim/recording/crowd_recorder.h"
#include "sim/recording/hold_warnings.h"
#include "sim/recording/trace_recorder.h"
#include "sim/vehicle/flight.h"
#include "world/scenario_crowd.h"
#include "world/trace.h"

namespace throng::sim {

namespace fs = std::filesystem;

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

/// A first move of a drone's goal, to learn whether the behavior file has it.
template <typename Crowd>
void check_goal(std::size_t drone, const world::GoalRef& goal, const Eigen::Vector2f& place,
                Crowd& crowd, std::vector<Problem>& problems) {
  try {
    crowd.move_goal(goal.set, goal.goal, place);
  } catch (const InputError&) {
    problems.push_back({"", fmt::format("/drones/{}/moves_goal", drone),
                        fmt::format("[{}, {}]", goal.set, goal.goal),
                        "a goal set and goal of the scenario's behavior file"});
  }
}

void check_goals(const std::vector<PlannedDrone>& drones, CrowdSource& crowd,
                 std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < drones.size(); ++i) {
    if (!drones[i].moves_goal) continue;
    check_goal(i, *drones[i].moves_goal, drones[i].start.head<2>().cast<float>(), crowd, problems);
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
  const auto present = crowd.present();
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

world::TraceHeader header_of(const world::Scenario& scenario, const RunSpec& spec,
                             const CrowdSource& crowd, const std::vector<world::AgentRole>& roles) {
  world::TraceHeader header = crowd.header(spec.seed);
  header.scenario_id = scenario.id;
  header.scenario_document = scenario.document;
  header.alarm = world::alarm_of(scenario);
  if (crowd.has_intents()) {
    for (const world::Exit& exit : scenario.exits) header.exit_ids.push_back(exit.id);
  }
  for (const DroneMission& mission : spec.drones) header.drone_ids.push_back(mission.id);
  header.role = roles;
  return header;
}

// In a recording everybody is a person: the scenario's dangers are agents of its own crowd.
std::vector<world::AgentRole> roles_of(const world::Scenario& scenario, const RunSpec& spec,
                                       const CrowdSource& crowd, std::vector<Problem>& problems) {
  const std::size_t agents = crowd.positions().size();
  const std::vector<int> none;
  std::vector<world::AgentRole> roles =
      choose_roles(scenario.id, spec.recorded ? none : scenario.disaster_agents, agents,
                   spec.people, spec.seed, problems);
  for (const world::Disaster& disaster : scenario.disasters) {
    const auto agent = static_cast<std::size_t>(disaster.agent);
    if (disaster.kind != world::DisasterKind::attacker || spec.recorded || agent >= agents)
      continue;
    roles[agent] = world::AgentRole::attacker;
  }
  return roles;
}

std::vector<Problem> warnings_of(const CrowdSource& crowd, const std::vector<PlannedDrone>& drones,
                                 const HoldWarnings& hold, const PropWatch& props) {
  std::vector<Problem> warnings = crowd.warnings();
  for (auto& warning : idle_goals(drones)) warnings.push_back(std::move(warning));
  for (auto& warning : possible_meetings(drones)) warnings.push_back(std::move(warning));
  warnings.insert(warnings.end(), hold.warnings().begin(), hold.warnings().end());
  warnings.insert(warnings.end(), props.problems().begin(), props.problems().end());
  return warnings;
}

}  // namespace

bool has_own_goal(const DroneMission& mission, const world::Scenario& scenario) {
  return mission.moves_goal && std::none_of(scenario.drones.begin(), scenario.drones.end(),
                                            [&](const world::DroneStart& known) {
                                              return known.id == mission.id &&
                                                     known.moves_goal == mission.moves_goal;
                                            });
}

void check_moved_goals(const std::vector<DroneMission>& missions, crowd::Simulation& crowd,
                       std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < missions.size(); ++i) {
    if (!missions[i].moves_goal) continue;
    check_goal(i, *missions[i].moves_goal, Eigen::Vector2f::Zero(), crowd, problems);
  }
}

std::string model_for(const world::Scenario& scenario, const CrowdSpec& spec) {
  if (!spec.model.empty()) return spec.model;
  if (!scenario.crowd_model.empty()) return scenario.crowd_model;
  return spec.compat == crowd::Compat::none ? "ttc" : "orca";
}

crowd::Simulation load_crowd(const world::Scenario& scenario, std::uint64_t seed,
                             const CrowdSpec& spec) {
  const crowd::CrowdDescription description = world::crowd_of(scenario);
  crowd::LoadOptions options;
  options.seed = seed;
  options.model = model_for(scenario, spec);
  options.compat = spec.compat;
  options.hard_separation = spec.hard_separation;
  options.compliance = spec.compliance;
  options.physical = spec.physical;
  return {description.scene, description.behavior, options};
}

std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              RunObserver& observer, const RunProgress& progress,
                              const std::stop_token& stop) {
  std::vector<Problem> problems;
  check_times(spec, problems);
  check_exits(scenario, problems);
  const std::vector<PlannedDrone> drones =
      plan_drones(scenario, spec.drones, spec.duration_s, problems);
  const std::unique_ptr<CrowdSource> source =
      spec.recorded ? replayed(spec.recorded, spec.seed)
                    : simulated(load_crowd(scenario, spec.seed, spec.crowd));
  CrowdSource& crowd = *source;
  const std::vector<world::AgentRole> roles = roles_of(scenario, spec, crowd, problems);
  check_goals(drones, crowd, problems);
  for (std::size_t i = 0; i < roles.size(); ++i) {
    crowd.set_present(i, roles[i] != world::AgentRole::absent);
  }
  std::vector<std::uint8_t> there;
  PropWatch props(scenario);
  props.look(crowd.positions(), people_there(crowd, roles, there), 0);
  problems.insert(problems.end(), props.problems().begin(), props.problems().end());
  if (!problems.empty()) throw InputError(std::move(problems));

  observer.begin(header_of(scenario, spec, crowd, roles));
  const double dt_s = crowd.dt_s();
  HoldWarnings hold;
  Flight flight(
      scenario.buildings, drones, dt_s, spec.physics_dt_s,
      {[&](std::size_t drone, const world::DroneSample& sample) { observer.drone(drone, sample); },
       [&](const world::TraceEvent& event) {
         observer.event(event);
         hold.record(event);
       },
       [&](std::size_t agent, const Eigen::Vector2d& impulse_ns) {
         crowd.strike(agent, impulse_ns.cast<float>());
       }},
      {spec.wind, spec.seed});
  const std::vector<world::GoalRef> moving_goals = goals_moved_by(drones);
  CrowdRecorder recorder(scenario, roles, moving_goals);
  GuidanceLoop guidance(scenario, roles, drones, spec.seed, dt_s);
  recorder.record(crowd, 0, observer);

  constexpr double kRounding = 1e-9;
  const auto steps = static_cast<long>(std::ceil(spec.duration_s / dt_s - kRounding));
  for (long step = 1; step <= steps && !observer.done(); ++step) {
    if (stop.stop_requested()) throw Cancelled();
    guidance.look(crowd, recorder, flight, static_cast<double>(step - 1) * dt_s);
    guidance.report(flight, observer);
    guidance.move_goals(flight, crowd);
    crowd.step();
    flight.advance({crowd.positions(), people_there(crowd, roles, there)});
    const double time_s = static_cast<double>(step) * dt_s;
    props.look(crowd.positions(), there, time_s);
    recorder.record(crowd, time_s, observer);
    report_falls(crowd, time_s, observer);
    report_closed_doors(scenario, static_cast<double>(step - 1) * dt_s, time_s, observer);
    if (progress) progress(std::min(time_s, spec.duration_s), spec.duration_s);
  }
  flight.finish();
  return warnings_of(crowd, drones, hold, props);
}

std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              const fs::path& trace_file, const RunProgress& progress,
                              const std::stop_token& stop, const fs::path& pilot_log_folder) {
  TraceRecorder recorder(trace_file, pilot_log_folder);
  std::vector<Problem> warnings = simulate(scenario, spec, recorder, progress, stop);
  recorder.finish();
  return warnings;
}

}  // namespace throng::sim
