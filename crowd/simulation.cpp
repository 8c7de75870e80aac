#include "crowd/simulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "crowd/behavior/load_behavior.h"
#include "crowd/behavior/machine.h"
#include "crowd/description/menge_files/read.h"
#include "crowd/elements/element.h"
#include "crowd/motion/bodies.h"
#include "crowd/motion/metered_doors.h"
#include "crowd/motion/motion.h"
#include "crowd/motion/separation.h"
#include "crowd/navigation/elevation.h"
#include "crowd/scene.h"
#include "crowd/spatial/grid.h"
#include "crowd/state/behavior.h"
#include "crowd/state/crowd.h"
#include "crowd/state/model.h"

namespace throng::crowd {

struct Simulation::State {
  State(const SceneDescription& scene_description, const BehaviorDescription& behavior_description,
        const LoadOptions& options);

  void step();
  void sub_step();

  Crowd crowd;
  LoadOptions options;
  int sub_steps = 1;
  std::vector<Problem> warnings;
  std::vector<std::string> state_names;
  std::unique_ptr<Machine> machine;
  std::unique_ptr<Model> model;
  std::unique_ptr<Separation> separation;  // where it is wanted
  std::unique_ptr<Bodies> bodies;          // where they give way
  MeteredDoors metered_doors;
  std::vector<Fall> falls;  // in this step
  Grid grid;
  std::vector<Eigen::Vector2f> new_velocity;
};

Simulation::State::State(const SceneDescription& scene_description,
                         const BehaviorDescription& behavior_description,
                         const LoadOptions& load_options)
    : options(load_options), metered_doors({}, 0) {
  const bool words_are_zero = options.compat != Compat::none;
  Reading scene(scene_description, "Experiment", words_are_zero);
  Reading behavior(behavior_description, "BFSM", words_are_zero);
  const ModelEntry& entry = find_model(options.model);
  state_names = load_state_names(behavior.root());
  if (options.separation == BodySeparation::automatic) {
    const bool hard = entry.separates && options.compat == Compat::none;
    options.separation = hard ? BodySeparation::hard : BodySeparation::soft;
  }
  crowd.compat = options.compat;
  crowd.compliance = options.compliance;
  crowd.model_constants = chosen_constants(entry, options.constants, options.seed);
  crowd.seed = options.seed;
  MengeSequences sequences(options.compat, options.seed);
  Scene parts = load_scene(scene.root(), state_names, entry, sequences, crowd);
  if (options.time_step_s) crowd.dt_s = *options.time_step_s;
  sub_steps = 1 + options.sub_steps;
  crowd.dt_s /= sub_steps;
  const std::size_t count = crowd.agents.count();
  Behavior made =
      load_behavior(behavior.root(), state_names, parts.profile_modifiers, sequences, crowd);
  std::move(parts.processes.begin(), parts.processes.end(), std::back_inserter(made.processes));
  made.modifiers.insert(made.modifiers.begin(), std::move_iterator(parts.modifiers.begin()),
                        std::move_iterator(parts.modifiers.end()));
  machine = std::make_unique<Machine>(std::move(made), count);
  model = entry.make(crowd);
  if (options.separation == BodySeparation::hard) separation = std::make_unique<Separation>(crowd);
  metered_doors = MeteredDoors(options.metered_doors, count);
  if (options.physical.on) bodies = std::make_unique<Bodies>(options.physical, count);
  new_velocity.resize(count, Eigen::Vector2f::Zero());
  machine->start(crowd);
  if (options.can_step) machine->prepare_to_step(crowd);
  warnings = scene.warnings();
  warnings.insert(warnings.end(), behavior.warnings().begin(), behavior.warnings().end());
}

void Simulation::State::step() {
  falls.clear();
  for (int i = 0; i < sub_steps; ++i) sub_step();
}

void Simulation::State::sub_step() {
  machine->run_processes_before(crowd);
  machine->take_transitions(crowd);
  machine->prefer(crowd);
  if (bodies) bodies->lie(crowd);
  grid.build(crowd.agents);
  model->step(crowd, grid, new_velocity);
  const std::span<const float> breadths = model->breadths();
  std::copy(breadths.begin(), breadths.end(), crowd.agents.breadth.begin());
  if (bodies) {
    bodies->react(crowd, grid, new_velocity);
    falls.insert(falls.end(), bodies->falls().begin(), bodies->falls().end());
  }
  metered_doors.hold(crowd, new_velocity);
  if (separation) separation->remember(crowd);
  move(crowd, new_velocity);
  if (separation) separation->separate(crowd);
  metered_doors.put_back(crowd);
  ++crowd.step;
  machine->run_processes_after(crowd);
}

Simulation::Simulation(const std::filesystem::path& scene_file,
                       const std::filesystem::path& behavior_file, const LoadOptions& options)
    : Simulation(read_scene(scene_file), read_behavior(behavior_file), options) {}

Simulation::Simulation(const SceneDescription& scene, const BehaviorDescription& behavior,
                       const LoadOptions& options)
    : state_(std::make_unique<State>(scene, behavior, options)) {}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::prepare_to_step() {
  if (std::exchange(state_->options.can_step, true)) return;
  state_->machine->prepare_to_step(state_->crowd);
}

void Simulation::step() {
  check(state_->options.can_step, "this crowd was loaded for stepping");
  state_->step();
}

const std::vector<Problem>& Simulation::warnings() const { return state_->warnings; }

const LoadOptions& Simulation::options() const { return state_->options; }

double Simulation::dt_s() const { return state_->crowd.dt_s * state_->sub_steps; }

double Simulation::time_s() const { return state_->crowd.time_s(); }

std::size_t Simulation::agent_count() const { return state_->crowd.agents.count(); }

bool Simulation::all_final() const {
  const Agents& agents = state_->crowd.agents;
  if (state_->crowd.awaited > 0) return false;
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if (agents.present[i] != 0 && !state_->machine->is_final(agents.state[i])) return false;
  }
  return true;
}

std::span<const Eigen::Vector2f> Simulation::positions() const {
  return state_->crowd.agents.position;
}

std::span<const Eigen::Vector2f> Simulation::velocities() const {
  return state_->crowd.agents.velocity;
}

std::span<const float> Simulation::yaws_rad() const { return state_->crowd.agents.yaw_rad; }

std::span<const float> Simulation::desired_speeds_mps() const {
  return state_->crowd.agents[Property::pref_speed];
}

std::span<const float> Simulation::radii_m() const {
  return state_->crowd.agents[Property::radius];
}

std::vector<float> Simulation::body_radii_m() const {
  const Agents& agents = state_->crowd.agents;
  std::vector<float> radii = agents[Property::radius];
  for (std::size_t i = 0; i < radii.size(); ++i) radii[i] *= agents.breadth[i];
  return radii;
}

std::span<const std::uint8_t> Simulation::states() const { return state_->crowd.agents.state; }

std::span<const GoalId> Simulation::goals() const { return state_->crowd.agents.goal_id; }

std::span<const std::uint8_t> Simulation::present() const { return state_->crowd.agents.present; }

std::span<const double> Simulation::planned_arrivals_s() const {
  return state_->crowd.planned_arrivals_s;
}

std::span<const std::uint8_t> Simulation::panicked() const { return state_->crowd.agents.panicked; }

std::span<const std::uint8_t> Simulation::fallen() const { return state_->crowd.agents.fallen; }

std::span<const Fall> Simulation::falls() const { return state_->falls; }

std::span<const std::int32_t> Simulation::social_groups() const {
  return state_->crowd.agents.social_group;
}

std::span<const std::int32_t> Simulation::agent_classes() const {
  return state_->crowd.agents.agent_class;
}

Eigen::Vector2f Simulation::preferred_velocity(std::size_t agent) const {
  const Agents& agents = state_->crowd.agents;
  return agents.preferred_speed[agent] * agents.preferred_direction[agent];
}

float Simulation::goal_distance_m(std::size_t agent) const {
  const Crowd& crowd = state_->crowd;
  const int goal = crowd.agents.goal[agent];
  return goal < 0 ? 0 : crowd.goals[goal].distance(crowd.agents.position[agent], crowd.compat);
}

float Simulation::ground_m(std::size_t agent) const {
  const Crowd& crowd = state_->crowd;
  return crowd.elevation ? crowd.elevation->height_m(crowd.agents.position[agent]) : 0;
}

bool Simulation::is_final(std::uint8_t state) const { return state_->machine->is_final(state); }

std::optional<bool> Simulation::is_lying(std::uint8_t state) const {
  return state_->machine->is_lying(state);
}

bool Simulation::has_exits(std::uint8_t state) const { return state_->machine->has_exits(state); }

const std::vector<std::string>& Simulation::state_names() const { return state_->state_names; }

void Simulation::set_present(std::size_t agent, bool present) {
  check(agent < agent_count(), "set_present is given one of the agents");
  Agents& agents = state_->crowd.agents;
  if (agents.awaited[agent] != 0) {
    if (present) return;  // in its own time
    agents.awaited[agent] = 0;
    --state_->crowd.awaited;
  }
  agents.present[agent] = present ? 1 : 0;
  if (!present) agents.velocity[agent].setZero();
}

void Simulation::burden(std::size_t agent, float radius_m, float speed_share) {
  Agents& agents = state_->crowd.agents;
  float& radius = agents[Property::radius][agent];
  radius = std::max(radius, radius_m);
  agents[Property::pref_speed][agent] *= speed_share;
}

void Simulation::strike(std::size_t agent, const Eigen::Vector2f& impulse_ns) {
  if (state_->bodies) state_->bodies->strike(agent, impulse_ns);
}

bool Simulation::has_goal(int set, int goal) const {
  return state_->crowd.goals.find_goal(set, goal) >= 0;
}

void Simulation::move_goal(int set, int goal, const Eigen::Vector2f& center) {
  const int index = state_->crowd.goals.find_goal(set, goal);
  if (index < 0) {
    throw InputError(Problem{"", "moved goal", fmt::format("goal {} of goal set {}", goal, set),
                             "a goal of the behavior file"});
  }
  state_->crowd.goals[index].shape->move_to(center);
}

void Simulation::fire(const std::string& trigger) {
  if (state_->machine->fire(trigger)) return;
  throw InputError(Problem{"", "fired trigger", trigger,
                           "the name of an external trigger of the behavior file"});
}

}  // namespace throng::crowd
