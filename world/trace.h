// The trace: the recording of one run, written by the simulation and read by all later stages. HDF5
// without time stamps, so equal runs give equal bytes; docs/trace.md defines the layout.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "world/alarm.h"
#include "world/trace_event.h"

namespace throng::world {

/// Tolerance for comparing times (s): step times are floating-point sums.
inline constexpr double kTimeSlackS = 1e-6;

enum class AgentRole : std::uint8_t {
  person = 0,
  disaster = 1,   ///< represents a disaster; neither rendered nor counted
  absent = 2,     ///< part of the scenario but not of this run; neither rendered nor counted
  attacker = 3,   ///< represents a disaster and is a person: rendered and labeled, but not counted
  spectator = 4,  ///< stays on a stand or on a prop's seat: rendered and labeled, but not counted
};

/// Whether agents with this role are people who are rendered and labeled.
constexpr bool is_visible_person(AgentRole role) {
  return role == AgentRole::person || role == AgentRole::attacker || role == AgentRole::spectator;
}

/// Bits of Trace::flags. kPresent: the agent takes part, that is, has arrived and not left yet.
/// kPanicked: is in panic. kFallen: has fallen and lies on the ground. kFollowing: heads for the
/// goal that a drone moves.
inline constexpr std::uint8_t kPresent = 1;
inline constexpr std::uint8_t kPanicked = 2;
inline constexpr std::uint8_t kFallen = 4;
inline constexpr std::uint8_t kFollowing = 8;

/// Whether people in a state with this name lie on the ground, for behaviors that do not declare
/// it: whether the name contains one of the words in docs/trace.md, ignoring case.
bool implies_lying(std::string_view state_name);

/// The state of people who stand and watch a show, of blueprints.
inline constexpr std::string_view kWatchState = "Watch";

/// States of people on stands (world/stand.h) and on seats of props (world/clutter/sitters.h), the
/// last ones of runs with such people.
inline constexpr std::array<std::string_view, 4> kStandStates = {"sitting", "standing", "cheering",
                                                                 "leaving"};

/// Index of the first of kStandStates among names that end with them; nothing for others.
std::optional<std::size_t> find_stand_states(const std::vector<std::string>& state_names);

/// Pedestrian model and settings that determine how the people of a run walk; the words are those
/// of `crowd` in jobs (docs/job.md).
struct CrowdOrigin {
  /// The pedestrian model (docs/crowd.md), or kRecordedCrowd for replayed trajectories. Empty for
  /// traces of earlier versions: the model is unknown and the other fields have no meaning.
  std::string model;
  std::string compat = "none";
  bool hard_separation = false;
  std::string constants = "best";  ///< choice of the model's constants
  double compliance = 1;
  bool physical = false;
  double fall_impulse_ns = 20;

  bool operator==(const CrowdOrigin&) const = default;
};
/// CrowdOrigin::model of replayed trajectories.
inline constexpr std::string_view kRecordedCrowd = "recorded";

/// Constant data of a run.
struct TraceHeader {
  std::string scenario_id;
  std::string generator;  ///< program and version, e.g. "throng 0.1.0"
  std::uint64_t seed = 0;
  double dt_s = 0.1;  ///< duration of a crowd step
  CrowdOrigin crowd;
  std::vector<std::string> state_names;  ///< indexed by Trace::state
  /// Per state: 1 if people in it lie on the ground. Empty: implies_lying() of the names decides.
  std::vector<std::uint8_t> state_lying;
  std::vector<std::string> exit_ids;  ///< indexed by Trace::exit_intent
  std::vector<std::string> drone_ids;
  /// Scenario::document; empty in traces of earlier versions and of recorded trajectories.
  std::string scenario_document;
  std::optional<Alarm> alarm;   ///< alarm of the scenario; set together with scenario_document
  std::vector<AgentRole> role;  ///< per agent; size = number of agents
  std::vector<float> radius_m;  ///< per agent
  std::vector<float> pref_speed_mps;  ///< per agent, as sampled at the start
  std::vector<std::int32_t> group;    ///< per agent: index of the social group; -1: alone

  std::size_t agent_count() const { return role.size(); }
  /// Returns per state whether people in it lie on the ground.
  std::vector<bool> lying_states() const;
  /// Index of the first of kStandStates; nothing for runs without spectators.
  std::optional<std::size_t> first_stand_state() const { return find_stand_states(state_names); }
};

/// The state of all agents at one crowd step; arrays have one entry per agent.
struct CrowdStep {
  double time_s = 0;
  std::vector<Eigen::Vector2f> position;  ///< m
  std::vector<Eigen::Vector2f> velocity;  ///< m/s
  std::vector<float> yaw_rad;             ///< heading, counter-clockwise from +x
  std::vector<float> desired_speed_mps;   ///< preferred speed at this step
  std::vector<std::uint8_t> state;        ///< index into TraceHeader::state_names
  std::vector<std::int8_t> exit_intent;   ///< index into exit_ids; -1: no exit
  std::vector<std::uint8_t> flags;        ///< kPresent | kPanicked | kFallen | kFollowing
};

/// The state of one drone at one instant; world frame unless stated otherwise.
struct DroneSample {
  double time_s = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
  Eigen::Vector3d body_rates = Eigen::Vector3d::Zero();             ///< rad/s, body
  /// All forces except gravity, divided by the mass: the reading of an ideal accelerometer. m/s²,
  /// body.
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();
  Eigen::Vector3d air_velocity = Eigen::Vector3d::Zero();  ///< wind with gusts, m/s, world
  double energy_j = 0;  ///< energy taken from the battery since the start
};

/// A time, expressed by the steps around it.
struct BetweenSteps {
  std::size_t before = 0;  ///< index of the last step at or before the time
  std::size_t after = 0;   ///< index of the next step; equal to `before` at the end
  float share = 0;         ///< fraction of the interval between the two steps, in [0, 1)
};

/// The sample as a trace keeps it: numbers are rounded, so that what follows from a trace can be
/// computed before it is written.
DroneSample as_recorded(const DroneSample& sample);

/// A whole trace in memory. Arrays over [step][agent] are row-major: see at().
struct Trace {
  TraceHeader header;
  std::vector<double> time_s;  ///< one per step, starting at 0, dt_s apart
  std::vector<Eigen::Vector2f> position;
  std::vector<Eigen::Vector2f> velocity;
  std::vector<float> yaw_rad;
  std::vector<float> desired_speed_mps;
  std::vector<std::uint8_t> state;
  std::vector<std::int8_t> exit_intent;
  std::vector<std::uint8_t> flags;
  std::vector<std::vector<DroneSample>> drones;  ///< per drone, sorted by time
  std::vector<TraceEvent> events;

  std::size_t steps() const { return time_s.size(); }
  /// Index of an agent's entry at a step in the arrays over [step][agent].
  std::size_t agents() const { return header.agent_count(); }
  std::size_t at(std::size_t step, std::size_t agent) const { return step * agents() + agent; }
  /// Whether an agent takes part at a step; otherwise its position has no meaning.
  bool present(std::size_t step, std::size_t agent) const {
    return (flags[at(step, agent)] & kPresent) != 0;
  }
  /// Returns the steps around a time; times outside the recording are clamped to it.
  BetweenSteps steps_around(double time_s) const;
  /// Position, velocity and heading of an agent that is present at `at.before`. Positions and
  /// headings are interpolated linearly; between two steps, the velocity is the difference of the
  /// positions over the time (at a step, the recorded one). An agent that is absent at the next
  /// step keeps its state until then; an agent that jumps keeps the velocity of the step before.
  Eigen::Vector2f position_at(const BetweenSteps& at, std::size_t agent) const;
  Eigen::Vector2f velocity_at(const BetweenSteps& at, std::size_t agent) const;
  float yaw_at(const BetweenSteps& at, std::size_t agent) const;
  double duration_s() const { return time_s.empty() ? 0.0 : time_s.back(); }
  /// State of a drone at a time: linear interpolation, spherical for the orientation; times are
  /// clamped to the recording.
  DroneSample drone_at(std::size_t drone, double time) const;
};

/// Writes a trace step by step. Memory does not grow with the duration of the run, except for its
/// events. The file appears at `path` only when finish() returns; a writer that is destroyed before
/// leaves no file. All member functions throw EnvironmentError if the file cannot be written.
class TraceWriter {
 public:
  TraceWriter(std::filesystem::path path, const TraceHeader& header);
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;

  /// Appends a step. Steps come in order, dt_s apart, starting at 0.
  void add(const CrowdStep& step);
  /// Appends a sample of one drone; the samples of a drone come in the order of time.
  void add_drone(std::size_t drone, const DroneSample& sample);
  /// Adds an event, in any order; the file has them sorted by time.
  void add_event(const TraceEvent& event);
  /// Completes the file and moves it to `path`. No member function may be called afterwards.
  void finish();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// Reads a whole trace. Throws EnvironmentError if the file cannot be read and InputError if it is
/// not a valid trace (wrong layout, truncated, other version).
Trace read_trace(const std::filesystem::path& path);

}  // namespace throng::world
