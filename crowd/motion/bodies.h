// Bodies that give way: people who are hit or pressed too hard are pushed, and fall.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/crowd.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// People who cannot walk as fast as they want press on those right ahead of them with the force
/// that would drive them, m (v_wanted - v) / tau (Helbing, Farkas & Vicsek 2000, eq. 1: m = 80 kg,
/// tau = 0.5 s), and those pass the force on to the people ahead of them in turn. Nobody ahead:
/// the push moves them. More than 1600 N per meter of somebody's girth and they fall (the same
/// paper's limit for injuries), and so do those struck with the impulse that the options
/// give. People who have fallen lie for kLiesS as obstacles on which no pressure acts, and then get
/// up.
class Bodies {
 public:
  static constexpr double kLiesS = 10;
  static constexpr float kMassKg = 80;
  static constexpr float kReactionS = 0.5F;
  static constexpr float kCrushNPerM = 1600;

  Bodies(const Physical& options, std::size_t agent_count);

  /// A blow from outside (N s), which is felt in the next step.
  void strike(std::size_t agent, const Eigen::Vector2f& impulse_ns);

  /// Sets the preferred speed of lying people to 0; call after all preferred velocities are set.
  void lie(Crowd& crowd) const;
  /// Changes the velocities that the model has chosen. `grid` holds everybody as they are.
  void react(Crowd& crowd, const Grid& grid, std::vector<Eigen::Vector2f>& velocity);

  /// People who fell in the last step.
  std::span<const Fall> falls() const { return falls_; }

 private:
  /// Somebody who touches somebody else, by slot of the grid.
  struct Touch {
    std::size_t slot;
    Eigen::Vector2f towards;  // unit
  };

  void take_blows(Crowd& crowd, std::vector<Eigen::Vector2f>& velocity);
  void find_touches(const Crowd& crowd, const Grid& grid);
  void press(const Crowd& crowd, const Grid& grid, const std::vector<Eigen::Vector2f>& velocity);
  /// Shares out what everybody pushes with; fills `given_` and `pressure_`, by slot.
  void hand_on();
  bool has_room(const Crowd& crowd, std::size_t agent) const;
  void fall(Crowd& crowd, const Fall& fall);

  Physical options_;
  std::vector<Eigen::Vector2f> blows_;  // by agent, N s
  std::vector<double> up_s_;            // by agent: when it may get up
  std::vector<Fall> falls_;
  // By slot.
  std::vector<std::size_t> first_touch_;  // in touches_, then the end
  std::vector<Touch> touches_;
  std::vector<Eigen::Vector2f> drive_;   // own force, N
  std::vector<Eigen::Vector2f> given_;   // by others, N
  std::vector<Eigen::Vector2f> handed_;  // the next iteration of it
  std::vector<float> pressure_;          // sum of others' forces, N
  std::vector<bool> hands_on_;           // somebody is ahead
};

}  // namespace throng::crowd
