// Counts the crossings of a door by one person, step by step.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "world/scenario.h"

namespace throng::metrics {

/// The line of an exit, and the frame of the exit: along the line and outward.
class ExitLine {
 public:
  /// The margins (m) widen the door beyond its ends `from` and `to`.
  ExitLine(const world::Exit& exit, double margin_from_m, double margin_to_m);

  /// Signed distance from the line (m), positive outside.
  double beyond_m(const Eigen::Vector2d& point) const;
  /// Whether the segment from `a` to `b`, which lie on different sides of the line, passes through
  /// the door.
  bool leads_through_door(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  /// Whether the point lies in front of or behind the door, within kDoorwayM of its line.
  bool is_in_doorway(const Eigen::Vector2d& point) const;
  /// Whether the point lies on the inner side within kDoorwayM of the door.
  bool is_just_before(const Eigen::Vector2d& point) const;

  static constexpr double kDoorwayM = 2;

 private:
  double along_m(const Eigen::Vector2d& point) const;
  bool is_in_width(double along_m) const {
    return min_along_m_ <= along_m && along_m < max_along_m_;
  }

  Eigen::Vector2d middle_;
  Eigen::Vector2d outward_;
  double min_along_m_, max_along_m_;
};

/// The lines of the exits, widened by `margin_m` at both jambs, since the discs of people overlap
/// them slightly; between exits that are nearer to each other, by half of the distance, so that a
/// person who passes there is counted at one of them.
std::vector<ExitLine> exit_lines(const std::vector<world::Exit>& exits, double margin_m);

/// Detects the crossings of one person, with hysteresis: a crossing counts once the person has
/// passed the door and is kHysteresisM beyond the line, outside of the scenario, or absent. The
/// next crossing requires the same distance on the other side, so that jitter on the line counts at
/// most once.
class CrossingCounter {
 public:
  static constexpr double kHysteresisM = 0.2;

  /// Adds the person's next position. Returns +1 for a crossing outward, -1 inward, else 0.
  /// `is_outside_place`: the position is outside of Scenario::inside, so that a crossing outward
  /// counts immediately.
  int step(const ExitLine& line, const Eigen::Vector2d& position, double time_s = 0,
           bool is_outside_place = false);
  /// Reports that the person is absent from now on. Returns +1 if this completes a crossing
  /// outward, else 0.
  int vanish();
  /// After step() returned a crossing: the interpolated time at which the person was on the line.
  double crossed_at_s() const { return crossed_at_s_; }
  /// Whether the person has passed the door outward and has not come back through it.
  bool has_left() const { return has_left_; }

 private:
  std::optional<Eigen::Vector2d> last_;
  double last_s_ = 0;
  double crossed_at_s_ = 0;
  bool outside_ = false;  ///< side of the last position beyond the hysteresis
  bool passed_ = false;   ///< has passed the door to the other side since then
  bool has_left_ = false;
};

}  // namespace throng::metrics
