// The trace: what one run recorded. Written once by the simulation, read by everything after it.
// HDF5 without time stamps, so equal runs give equal bytes; the layout is in docs/trace.md.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "world/alarm.h"
#include "world/trace_event.h"

namespace throng::world {

/// Times are sums of steps in floating point: two that are nearer than this are the same step.
inline constexpr double kTimeSlackS = 1e-6;

enum class AgentRole : std::uint8_t {
  person = 0,
  disaster = 1,  ///< an agent that represents a hazard; neither rendered nor counted
  absent = 2,    ///< in the scenario but not in this run; neither rendered nor counted
  attacker = 3,  ///< a hazard that is a person: rendered and labeled as one, but not counted
};

/// Bits of Trace::flags, what an agent is at a step: takes part, i.e. has arrived and not left yet;
/// is in panic; has fallen and lies on the ground; heads for the goal that a drone moves.
inline constexpr std::uint8_t kPresent = 1;
inline constexpr std::uint8_t kPanicked = 2;
inline constexpr std::uint8_t kFallen = 4;
inline constexpr std::uint8_t kFollowing = 8;

/// Whether people in a state of this name lie on the ground, where nothing else says so: the name
/// contains one of the words in docs/trace.md, in upper or lower case.
bool implies_lying(std::string_view state_name);

/// Model and settings that moved a run's people, as far as they decide how people walk; words are
/// those of a job's `crowd` (docs/job.md).
struct CrowdOrigin {
  /// The pedestrian model (docs/crowd.md); kRecordedCrowd where trajectories were replayed; empty:
  /// not known, as in files of earlier versions, and the rest means nothing.
  std::string model;
  std::string compat = "none";
  bool hard_separation = false;
  double compliance = 1;
  bool physical = false;
  double fall_impulse_ns = 20;

  bool operator==(const CrowdOrigin&) const = default;
};
inline constexpr std::string_view kRecordedCrowd = "recorded";

/// Constant data of a run.
struct TraceHeader {
  std::string scenario_id;
  std::string generator;  ///< "throng 0.1.0"
  std::uint64_t seed = 0;
  double dt_s = 0.1;  ///< crowd step
  CrowdOrigin crowd;
  std::vector<std::string> state_names;  ///< index = value in Trace::state
  /// Per state: 1 if people in it lie on the ground. Empty: the names decide (implies_lying).
  std::vector<std::uint8_t> state_lying;
  std::vector<std::string> exit_ids;  ///< index = value in Trace::exit_intent
  std::vector<std::string> drone_ids;
  /// Scenario::document; empty in files of earlier versions and where a recording was read.
  std::string scenario_document;
  std::optional<Alarm> alarm;         ///< with scenario_document: the scenario's (world/alarm.h)
  std::vector<AgentRole> role;        ///< per agent; size = number of agents
  std::vector<float> radius_m;        ///< per agent
  std::vector<float> pref_speed_mps;  ///< per agent, as generated
  std::vector<std::int32_t> group;    ///< per agent: number of its social group; -1: walks alone

  std::size_t agent_count() const { return role.size(); }
  /// Per state: whether people in it lie on the ground.
  std::vector<bool> lying_states() const;
};

/// All agents at one crowd step.
struct CrowdStep {
  double time_s = 0;
  std::vector<Eigen::Vector2f> position;  ///< m
  std::vector<Eigen::Vector2f> velocity;  ///< m/s
  std::vector<float> yaw_rad;             ///< facing, counter-clockwise from +x
  std::vector<float> desired_speed_mps;   ///< what the agent wants now
  std::vector<std::uint8_t> state;        ///< index into TraceHeader::state_names
  std::vector<std::int8_t> exit_intent;   ///< index into exit_ids; -1: none
  std::vector<std::uint8_t> flags;        ///< kPresent, kPanicked, kFallen, kFollowing
};

/// One drone at one instant.
struct DroneSample {
  double time_s = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
  Eigen::Vector3d body_rates = Eigen::Vector3d::Zero();             ///< rad/s, body
  /// All forces but gravity over mass: what an ideal accelerometer reads. m/s², body.
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();
  Eigen::Vector3d air_velocity = Eigen::Vector3d::Zero();  ///< wind with gusts here, m/s, world
  double energy_j = 0;                                     ///< taken from the battery so far
};

/// A time between two steps of a trace.
struct BetweenSteps {
  std::size_t before = 0;  ///< the last one at or before the time
  std::size_t after = 0;   ///< the next one; the same at the end
  float share = 0;         ///< of the way from one to the other, in [0, 1)
};

/// A whole trace in memory. Arrays over [step][agent] are row-major.
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
  std::vector<std::vector<DroneSample>> drones;  ///< per drone, by time
  std::vector<TraceEvent> events;

  std::size_t steps() const { return time_s.size(); }
  std::size_t agents() const { return header.agent_count(); }
  std::size_t at(std::size_t step, std::size_t agent) const { return step * agents() + agent; }
  /// Whether an agent takes part at a step; where it is means nothing otherwise.
  bool present(std::size_t step, std::size_t agent) const {
    return (flags[at(step, agent)] & kPresent) != 0;
  }
  /// The steps around a time; times before the first and after the last one are theirs.
  BetweenSteps steps_around(double time_s) const;
  /// Place, velocity and facing of an agent who is present at `at.before`: linear between steps, so
  /// that the velocity between two is that of getting from one to the other, and at a step the
  /// step's. An agent who leaves before the next step stays until then, and one who jumps has the
  /// velocity of the step before.
  Eigen::Vector2f position_at(const BetweenSteps& at, std::size_t agent) const;
  Eigen::Vector2f velocity_at(const BetweenSteps& at, std::size_t agent) const;
  float yaw_at(const BetweenSteps& at, std::size_t agent) const;
  double duration_s() const { return time_s.empty() ? 0.0 : time_s.back(); }
  /// The drone between its samples: all linear but the orientation, which is slerped; clamped to
  /// the recorded span.
  DroneSample drone_at(std::size_t drone, double time) const;
};

/// Writes a trace step by step; memory does not grow with the run's length,
/// but for its events. The file appears at
/// `path` only when finish() returns; a writer destroyed before that leaves nothing behind.
class TraceWriter {
 public:
  TraceWriter(std::filesystem::path path, const TraceHeader& header);
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;

  /// Steps come in order, dt_s apart, starting at 0, with one entry per agent in every array.
  void add(const CrowdStep& step);
  /// Samples of one drone come in order of time.
  void add_drone(std::size_t drone, const DroneSample& sample);
  /// Events may come in any order; the file has them by time.
  void add_event(const TraceEvent& event);
  /// Completes the file and gives it its name. Throws EnvironmentError, as all of these do, when
  /// the disk fails; call nothing afterwards.
  void finish();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// Reads a whole trace. Throws EnvironmentError when the file cannot be read and InputError when
/// it is not a trace (wrong layout, truncated, other version).
Trace read_trace(const std::filesystem::path& path);

}  // namespace throng::world
