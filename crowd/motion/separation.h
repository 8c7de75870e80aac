// Bodies that never interpenetrate: a projection of the agents' places after they have moved.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/compute/parallel.h"
#include "crowd/crowd.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// Keeps the bodies of those who are present from overlapping by more than kTolerance, for any
/// time step. Overlapping pairs are moved apart, all at once and again until nobody overlaps any
/// more; nobody is moved nearer to a wall than their radius, or than they were before the step.
/// If there is no room for that, those who would overlap stay where they were: if nobody
/// overlapped before a step, nobody does after it. Agents that overlap in the beginning, or were
/// moved there, are moved apart as fast as room allows. Velocities become those actually walked.
class Separation {
 public:
  static constexpr float kTolerance = 0.01F;  // m

  explicit Separation(const Crowd& crowd);

  /// To be called before agents move.
  void remember(const Crowd& crowd);
  /// To be called after they have moved.
  void separate(Crowd& crowd);

 private:
  /// By slot of the grid.
  struct Body {
    Eigen::Vector2f position;
    Eigen::Vector2f push;  // half of all overlaps, away from the others
    float clearance = 0;   // from walls, m
    float overlap = 0;     // the worst, m
    bool stays = false;    // where it was before the step
  };

  void sort(const Crowd& crowd);
  /// Finds overlaps and pushes; returns the worst overlap.
  float look_around();
  void look_around(std::size_t slot);
  void push_apart(const Crowd& crowd);
  Eigen::Vector2f kept_off_walls(const Crowd& crowd, std::size_t slot,
                                 const Eigen::Vector2f& wanted,
                                 std::vector<Obstacles::Near>& walls) const;
  /// Returns agents that still overlap to where they were; false when all of them are.
  bool send_back();

  Grid grid_;        // where everybody was moved to at first
  float drift_ = 0;  // how far anybody is from there, m
  float largest_radius_ = 0;
  std::vector<Eigen::Vector2f> before_;  // the step, by agent
  std::vector<float> clearance_before_;  // by agent
  std::vector<Body> bodies_;
  PerThread<std::vector<Obstacles::Near>> walls_;
};

}  // namespace throng::crowd
