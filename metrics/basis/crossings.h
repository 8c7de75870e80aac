// Counting who goes through a door, one person at a time, step by step.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "world/scenario.h"

namespace throng::metrics {

/// The line of an exit, in the exit's own frame.
class ExitLine {
 public:
  /// `margin_m` widens the door at both jambs: the discs of people rub along them.
  ExitLine(const world::Exit& exit, double margin_m);

  /// Distance beyond the line, outward positive (m).
  double beyond_m(const Eigen::Vector2d& point) const;
  /// Whether the straight line from `a` to `b`, which lie on different sides, leads through the
  /// door.
  bool leads_through_door(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  /// Whether the point lies before or behind the door, kDoorwayM from its line at most.
  bool is_in_doorway(const Eigen::Vector2d& point) const;

  static constexpr double kDoorwayM = 2;

 private:
  double along_m(const Eigen::Vector2d& point) const;

  Eigen::Vector2d middle_;
  Eigen::Vector2d outward_;
  double half_width_m_;
};

/// Signed crossings of one person. A crossing counts once the person, having passed the door, is
/// kHysteresisM beyond the line, outside of the scenario, or gone; from then on it takes as much on
/// the other side to count again, so somebody who jitters on the line counts once at most.
class CrossingCounter {
 public:
  static constexpr double kHysteresisM = 0.2;

  /// The person's next position. Returns +1 for a crossing outward, -1 inward, else 0.
  /// `is_outside_place`: the position is outside of Scenario::inside, so a crossing outward counts
  /// at once.
  int step(const ExitLine& line, const Eigen::Vector2d& position, double time_s = 0,
           bool is_outside_place = false);
  /// The person is gone. Returns +1 if that completes a crossing outward, else 0.
  int vanish();
  /// After step() returned a crossing: when the person was on the line, between two steps.
  double crossed_at_s() const { return crossed_at_s_; }
  /// Whether the person has passed the door outward and not come back over its line.
  bool has_left() const { return has_left_; }

 private:
  std::optional<Eigen::Vector2d> last_;
  double last_s_ = 0;
  double crossed_at_s_ = 0;
  bool outside_ = false;  ///< the side that the person was last clear of the line on
  bool passed_ = false;   ///< has gone through the door to the other side since then
  bool has_left_ = false;
};

}  // namespace throng::metrics
