// The crowd engine: agents, their state machine and their pedestrian model, advanced in time steps.
// The engine does not know drones; its owner moves the goals that follow drones.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "crowd/agents/types.h"
#include "crowd/description/description.h"

namespace throng::crowd {

/// A running crowd. Results depend only on the descriptions, the options and the seed, not on the
/// number of threads. One thread at a time may use an object. Spans are valid until the next call
/// of a member function that is not const; arrays have one entry per agent.
class Simulation {
 public:
  /// Loads a Menge scene and behavior file. Throws InputError (file, line, element, found,
  /// expected) for unknown or invalid content, EnvironmentError for unreadable files.
  Simulation(const std::filesystem::path& scene_file, const std::filesystem::path& behavior_file,
             const LoadOptions& options);
  /// Creates a crowd from descriptions, e.g. those of SceneBuilder and BehaviorBuilder, which need
  /// not outlive the constructor. Throws like the constructor above; for elements that were built
  /// in code, messages name the element instead of file and line.
  Simulation(const SceneDescription& scene, const BehaviorDescription& behavior,
             const LoadOptions& options);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Returns the parts of the descriptions that were ignored.
  const std::vector<Problem>& warnings() const;

  /// Makes a crowd that was loaded without LoadOptions::can_step one that can.
  void prepare_to_step();
  /// Advances time by dt_s().
  void step();

  /// Returns the options given to the constructor.
  /// The time step, including all sub-steps.
  const LoadOptions& options() const;
  double dt_s() const;
  double time_s() const;
  std::size_t agent_count() const;
  /// Whether no agent is still to arrive and all present agents are in final states.
  bool all_final() const;

  std::span<const Eigen::Vector2f> positions() const;   ///< m
  std::span<const Eigen::Vector2f> velocities() const;  ///< m/s
  /// Headings, counter-clockwise from +x.
  std::span<const float> yaws_rad() const;
  /// Preferred speeds, as states' actions set them.
  std::span<const float> desired_speeds_mps() const;
  std::span<const float> radii_m() const;
  /// The radii that bodies take now: less than radii_m() where shoulders are turned.
  std::vector<float> body_radii_m() const;
  std::span<const std::uint8_t> states() const;  ///< indices into state_names()
  std::span<const GoalId> goals() const;
  /// 1: the agent takes part, that is, has arrived and not left yet.
  std::span<const std::uint8_t> present() const;
  /// When agents are to arrive who are not there at the start, s, in no order; they come later
  /// where others are in the way.
  std::span<const double> planned_arrivals_s() const;
  std::span<const std::uint8_t> panicked() const;  ///< 1: in panic
  std::span<const std::uint8_t> fallen() const;    ///< 1: lies on the ground (see Physical)
  std::span<const Fall> falls() const;             ///< falls during the last step
  /// Number of each agent's social group, whose members walk together; -1: alone.
  std::span<const std::int32_t> social_groups() const;
  std::span<const std::int32_t> agent_classes() const;  ///< classes given in profiles, for reports
  /// Velocity without other agents, m/s.
  Eigen::Vector2f preferred_velocity(std::size_t agent) const;
  /// Distance from the agent to its goal; 0 if it has none.
  float goal_distance_m(std::size_t agent) const;
  /// Height of the ground at the agent.
  float ground_m(std::size_t agent) const;
  const std::vector<std::string>& state_names() const;
  bool is_final(std::uint8_t state) const;
  /// Whether people in the state lie on the ground; empty if the description does not say.
  std::optional<bool> is_lying(std::uint8_t state) const;
  bool has_exits(std::uint8_t state) const;  ///< whether a transition leads out of it

  /// Sets whether an agent takes part. An absent agent does not move, does not change its state and
  /// is ignored by the others. All agents are present at the start, except those still to arrive:
  /// `true` has no effect on them, and `false` cancels their arrival.
  void set_present(std::size_t agent, bool present);

  /// Lets an agent take up at least this much room and prefer a share of its speed, since it leads
  /// something.
  void burden(std::size_t agent, float radius_m, float speed_share);

  /// Applies an impulse (N s) to an agent during the next step; ignored unless Physical::on.
  void strike(std::size_t agent, const Eigen::Vector2f& impulse_ns);

  bool has_goal(int set, int goal) const;
  /// Moves the center of a goal, e.g. to a drone. Throws InputError if there is no such goal.
  void move_goal(int set, int goal, const Eigen::Vector2f& center);

  /// Fires the external triggers of the behavior file with this name; their events take effect in
  /// the next step. Throws InputError if there is no such trigger.
  void fire(const std::string& trigger);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace throng::crowd
