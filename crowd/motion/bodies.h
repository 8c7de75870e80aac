// Bodies that are pushed and fall under impacts and pressure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/spatial/grid.h"
#include "crowd/state/crowd.h"

namespace throng::crowd {

/// People who cannot walk as fast as they want press on those directly ahead with the force m
/// (v_wanted - v) / tau (Helbing, Farkas and Vicsek 2000, eq. 1: m = 80 kg, tau = 0.5 s). Those
/// pass the force on to the people ahead of them, or are moved by it if there is nobody. A person
/// falls at more than 1600 N per meter of body circumference (limit for injuries in the same
/// paper), or after an impact with the impulse Physical::fall_impulse_ns. People who have fallen
/// lie for kLiesS as obstacles without pressure and then get up.
class Bodies {
 public:
  static constexpr double kLiesS = 10;
  static constexpr float kMassKg = 80;
  static constexpr float kReactionS = 0.5F;
  static constexpr float kCrushNPerM = 1600;

  Bodies(const Physical& options, std::size_t agent_count);

  /// Records an impact from outside (N s), which acts in the next step.
  void strike(std::size_t agent, const Eigen::Vector2f& impulse_ns);

  /// Sets the preferred speed of lying people to 0. Called after all preferred velocities are set.
  void lie(Crowd& crowd) const;
  /// Changes the velocities of the pedestrian model. `grid` has the current positions.
  void react(Crowd& crowd, const Grid& grid, std::vector<Eigen::Vector2f>& velocity);

  /// Returns the falls of the last step.
  std::span<const Fall> falls() const { return falls_; }

 private:
  /// Contact of an agent with another one, by slot of the grid.
  struct Touch {
    std::size_t slot;
    Eigen::Vector2f towards;  // unit
  };

  void take_blows(Crowd& crowd, std::vector<Eigen::Vector2f>& velocity);
  void find_touches(const Crowd& crowd, const Grid& grid);
  void press(const Crowd& crowd, const Grid& grid, const std::vector<Eigen::Vector2f>& velocity);
  /// Distributes the forces of all agents; sets `given_` and `pressure_`, by slot.
  void hand_on();
  bool has_room(const Crowd& crowd, std::size_t agent) const;
  void fall(Crowd& crowd, const Fall& fall);

  Physical options_;
  std::vector<Eigen::Vector2f> blows_;  // impulses, by agent, N s
  std::vector<double> up_s_;            // by agent: time of getting up
  std::vector<Fall> falls_;
  // Indexed by slot.
  std::vector<std::size_t> first_touch_;  // index in touches_, and the end
  std::vector<Touch> touches_;
  std::vector<Eigen::Vector2f> drive_;   // force of the agent itself, N
  std::vector<Eigen::Vector2f> given_;   // force of others, N
  std::vector<Eigen::Vector2f> handed_;  // `given_` of the next iteration
  std::vector<float> pressure_;          // sum of the magnitudes of others' forces, N
  std::vector<bool> hands_on_;           // whether somebody is ahead
};

}  // namespace throng::crowd
