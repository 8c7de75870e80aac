// The crowd engine: agents, their state machine and their pedestrian model, stepped in time.
// Knows nothing of drones, GL or HTTP; its owner moves the goals that follow something.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "crowd/description/description.h"
#include "crowd/types.h"

namespace throng::crowd {

/// A running crowd. Results depend on the descriptions and the seed only, not on the number of
/// threads.
class Simulation {
 public:
  /// Loads a Menge scene and behavior file. Throws InputError (file, line, element, found,
  /// expected) for anything it does not understand, EnvironmentError for unreadable files.
  Simulation(const std::filesystem::path& scene_file, const std::filesystem::path& behavior_file,
             const LoadOptions& options);
  /// Makes a crowd from descriptions, e.g. of SceneBuilder and BehaviorBuilder. They may go
  /// afterwards. Throws like the constructor above; of elements that were built in code errors say
  /// so, and which they are.
  Simulation(const SceneDescription& scene, const BehaviorDescription& behavior,
             const LoadOptions& options);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Parts of the files that were ignored while loading.
  const std::vector<Problem>& warnings() const;

  /// Advances by dt_s().
  void step();

  /// As the crowd was made with, its model by name.
  const LoadOptions& options() const;
  double dt_s() const;
  double time_s() const;
  std::size_t agent_count() const;
  /// Nobody is still to arrive, and every agent that takes part is in a final state.
  bool all_final() const;

  std::span<const Eigen::Vector2f> positions() const;   ///< m
  std::span<const Eigen::Vector2f> velocities() const;  ///< m/s
  std::span<const float> yaws_rad() const;
  std::span<const float> desired_speeds_mps() const;  ///< preferred speed, as set by state actions
  std::span<const float> radii_m() const;
  std::span<const std::uint8_t> states() const;  ///< index into state_names()
  std::span<const GoalId> goals() const;
  /// 1: takes part, i.e. has arrived and not left yet.
  std::span<const std::uint8_t> present() const;
  std::span<const std::uint8_t> panicked() const;  ///< 1: is in panic
  std::span<const std::uint8_t> fallen() const;    ///< 1: lies on the ground (Physical)
  std::span<const Fall> falls() const;             ///< who fell in the last step
  /// Who walks with whom: agents of a social group have the same number; -1: alone.
  std::span<const std::int32_t> social_groups() const;
  std::span<const std::int32_t> agent_classes() const;  ///< as profiles number them, for reports
  Eigen::Vector2f preferred_velocity(std::size_t agent) const;  ///< if it were alone, m/s
  float ground_m(std::size_t agent) const;                      ///< height where it stands
  const std::vector<std::string>& state_names() const;
  bool is_final(std::uint8_t state) const;
  /// Whether people in the state lie on the ground; null if its description does not say so.
  std::optional<bool> is_lying(std::uint8_t state) const;
  bool has_exits(std::uint8_t state) const;  ///< some transition leads out of it

  /// Whether an agent takes part; one that does not neither moves nor is seen by others, and its
  /// state rests. All do at first, but for those who are still to arrive, who then never do.
  void set_present(std::size_t agent, bool present);

  /// Hits somebody (N s): felt in the next step, and only where bodies are Physical.
  void strike(std::size_t agent, const Eigen::Vector2f& impulse_ns);

  /// Moves a goal's center, e.g. to a drone. Throws InputError when there is no such goal.
  void move_goal(int set, int goal, const Eigen::Vector2f& center);

  /// Fires the behavior file's external triggers of this name; their events happen in the next
  /// step. Throws InputError when there is none.
  void fire(const std::string& trigger);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace throng::crowd
