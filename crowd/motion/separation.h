// Hard separation: correction of the positions of overlapping bodies after each step.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "base/compute/parallel.h"
#include "crowd/spatial/grid.h"
#include "crowd/state/crowd.h"

namespace throng::crowd {

/// Prevents the bodies of present agents from overlapping by more than kTolerance, for any time
/// step. All overlapping pairs are moved apart simultaneously and repeatedly until none overlaps.
/// An agent is not moved nearer to a wall than its radius, or than before the step. If there is no
/// room, the overlapping agents return to their positions before the step: a crowd without overlaps
/// stays without overlaps. Agents that overlap at the start, or were moved so from outside, are
/// moved apart as fast as room permits. Velocities are set to the actual motion.
class Separation {
 public:
  static constexpr float kTolerance = 0.01F;  // m

  explicit Separation(const Crowd& crowd);

  /// Must be called before agents move.
  void remember(const Crowd& crowd);
  /// Must be called after agents have moved.
  void separate(Crowd& crowd);

 private:
  /// State of an agent, by slot of the grid.
  struct Body {
    Eigen::Vector2f position;
    Eigen::Vector2f push;  // half of the sum of overlaps, away from the others
    float clearance = -1;  // distance from walls, m; -1: not yet known
    float overlap = 0;     // max overlap, m
    bool stays = false;    // whether it returns to the position before the step
    bool strayed = false;  // whether it has moved so far that lists of those near do not hold
    bool moved = false;    // whether it has moved in this round
    bool changed = false;  // whether it is in the list of those whose surroundings have moved
  };

  /// The slots that an agent may touch until it or they have moved by kSlackM / 2.
  struct Near {
    static constexpr std::size_t kMany = 12;
    std::size_t count = 0;  // above kMany: more than fit
    std::array<std::uint32_t, kMany> slots{};
  };
  static constexpr float kSlackM = 0.2F;

  void sort(const Crowd& crowd);
  void find_near();
  /// Computes the overlaps and pushes of all; returns the max overlap.
  float look_around();
  /// The same of those only whose surroundings have moved since.
  float look_again();
  void look_around(std::size_t slot);
  void add_overlap(std::size_t slot, std::size_t other);
  void note_strayed(std::size_t slot);
  /// Calls act(slot) for the slots that a body which has moved may have begun or ceased to touch.
  template <typename Act>
  void for_each_touched(std::size_t slot, const Act& act) const;
  float keep_overlapping();
  void push_apart(const Crowd& crowd);
  float clearance_before_m(const Crowd& crowd, std::size_t slot,
                           std::vector<Obstacles::Near>& walls) const;
  Eigen::Vector2f kept_off_walls(const Crowd& crowd, std::size_t slot,
                                 const Eigen::Vector2f& wanted,
                                 std::vector<Obstacles::Near>& walls) const;
  /// Returns overlapping agents to their positions before the step; false if all of them are there.
  bool send_back();

  Grid grid_;        // positions after the step, before corrections
  float drift_ = 0;  // max distance of an agent from that position, m
  float largest_radius_ = 0;
  std::vector<Eigen::Vector2f> before_;  // positions before the step, by agent
  std::vector<Body> bodies_;
  std::vector<Near> near_;
  // Slots:
  std::vector<std::uint32_t> overlapping_;
  std::vector<std::uint32_t> changed_;  // whose surroundings have moved
  std::vector<std::uint32_t> strayed_;
  PerThread<std::vector<Obstacles::Near>> walls_;
};

}  // namespace throng::crowd
