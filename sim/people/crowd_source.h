// Source of a run's people: the crowd engine, or a recording that is replayed.
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

class CrowdSource {
 public:
  CrowdSource() = default;
  virtual ~CrowdSource() = default;
  CrowdSource(const CrowdSource&) = delete;
  CrowdSource& operator=(const CrowdSource&) = delete;

  virtual double dt_s() const = 0;
  /// Constant data of the trace: everybody is a person, there are no exits and no drones.
  virtual world::TraceHeader header(std::uint64_t seed) const = 0;
  /// Everybody as they are now; nobody heads for an exit. The time is the caller's to fill in.
  virtual world::CrowdStep now() const = 0;

  virtual std::span<const Eigen::Vector2f> positions() const = 0;   ///< m
  virtual std::span<const Eigen::Vector2f> velocities() const = 0;  ///< m/s
  virtual std::span<const std::uint8_t> present() const = 0;        ///< 1: takes part now
  virtual std::span<const crowd::GoalId> goals() const = 0;
  virtual std::span<const crowd::Fall> falls() const = 0;  ///< who fell in the last step
  virtual std::vector<Problem> warnings() const = 0;
  /// Whether these people use the scenario's exits.
  virtual bool has_intents() const = 0;

  virtual void step() = 0;
  /// See crowd::Simulation. Recorded people neither leave their paths nor react to moving objects.
  virtual void set_present(std::size_t agent, bool present) = 0;
  virtual void move_goal(int set, int goal, const Eigen::Vector2f& center) = 0;
  virtual void strike(std::size_t agent, const Eigen::Vector2f& impulse_ns) = 0;
};

/// A crowd that the engine moves.
std::unique_ptr<CrowdSource> simulated(crowd::Simulation crowd);

/// A recording (world::Trace without intents), played once at dt_s = replay_step_s(recording).
/// Between recorded frames people move straight; a person who is missing in one of the two frames
/// around a time is absent. After the last frame nobody is present. A person who never moves gets a
/// random heading, by the seed.
std::unique_ptr<CrowdSource> replayed(std::shared_ptr<const world::Trace> recording,
                                      std::uint64_t seed);

/// The step of a replay: that of the recording if it has 5 to 60 frames a second, else the nearest
/// of its whole multiples or parts that has.
double replay_step_s(double recorded_dt_s);

}  // namespace throng::sim
