// The source of a run's people: the crowd engine, or the replay of a recording.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/error.h"
#include "crowd/simulation.h"
#include "world/trace.h"

namespace throng::sim {

/// The interface to a run's people. Spans are valid until step(); all except falls() have one
/// element per agent.
class CrowdSource {
 public:
  CrowdSource() = default;
  virtual ~CrowdSource() = default;
  CrowdSource(const CrowdSource&) = delete;
  CrowdSource& operator=(const CrowdSource&) = delete;

  virtual double dt_s() const = 0;
  /// Constant data of the trace; all agents are persons, and there are no exits and drones.
  virtual world::TraceHeader header(std::uint64_t seed) const = 0;
  /// The current state of all agents, without intents. The caller sets the time.
  virtual world::CrowdStep now() const = 0;

  virtual std::span<const Eigen::Vector2f> positions() const = 0;   ///< m
  virtual std::span<const Eigen::Vector2f> velocities() const = 0;  ///< m/s
  virtual std::span<const std::uint8_t> present() const = 0;        ///< 1: present now
  /// 1: present now, and not on a stand.
  virtual std::span<const std::uint8_t> on_ground() const { return present(); }
  virtual std::span<const crowd::GoalId> goals() const = 0;
  virtual std::span<const crowd::Fall> falls() const = 0;  ///< falls in the last step
  virtual std::vector<Problem> warnings() const = 0;
  /// Whether people have intents, that is, head for the scenario's exits.
  virtual bool has_intents() const = 0;

  virtual void step() = 0;
  /// The next three are as in crowd::Simulation. A replay ignores move_goal() and strike().
  virtual void set_present(std::size_t agent, bool present) = 0;
  virtual void move_goal(int set, int goal, const Eigen::Vector2f& center) = 0;
  virtual void strike(std::size_t agent, const Eigen::Vector2f& impulse_ns) = 0;
};

/// A crowd simulated by the engine.
std::unique_ptr<CrowdSource> simulated(crowd::Simulation crowd);

/// A recording (world::Trace without intents), played once with the step replay_step_s(). Positions
/// between frames are interpolated linearly; a person who is missing in one of the two frames
/// around a time is absent. After the last frame nobody is present. A person who never moves has a
/// random heading, by the seed.
std::unique_ptr<CrowdSource> replayed(std::shared_ptr<const world::Trace> recording,
                                      std::uint64_t seed);

/// The step of a replay: that of the recording if it has 5 to 60 frames per second, else the
/// nearest integer multiple or fraction of it that has.
double replay_step_s(double recorded_dt_s);

}  // namespace throng::sim
