// The queue before an exit.
#pragma once

#include <deque>
#include <span>

#include "metrics/basis/control_zone.h"
#include "metrics/basis/near_people.h"

namespace throng::metrics {

struct Queue {
  int people = 0;
  /// From the exit's middle along the queue to the farthest person along it.
  double length_m = 0;
  /// Extent along the door of those of the queue who are in the control zone.
  double breadth_m = 0;
};

/// People who intend the exit, are on its inner side, slower than half of their desired speed, and
/// linked to the control zone: two such people are linked within 1.2 m. Path along the queue: from
/// person to person over links, from the first one in the zone straight to the exit's middle.
Queue queue_before(const ControlZone& zone, const Eigen::Vector2d& outward,
                   std::span<const NearPerson> people);

/// How long the last one of a queue will wait: the queue over the rate at which the door serves it.
/// The rate is that of the last 20 s, of the times in which there was a queue only, together with
/// kPriorS seconds at the capacity of that part of the door before which the queue stands: what
/// nobody has measured yet is taken to be as doors are. (The mean of a gamma distribution of the
/// rate after so much time, with that prior.)
class WaitPredictor {
 public:
  static constexpr double kWindowS = 20;
  static constexpr double kPriorS = 10;

  /// Predicts waits at a door of this width, in a trace with steps of dt_s, for people of this mean
  /// radius.
  WaitPredictor(double width_m, double mean_radius_m, double dt_s);

  /// After one more step (s). `crossed_out`: outward crossings since the start.
  double step(const Queue& queue, int crossed_out);

 private:
  struct Step {
    bool queued = false;
    int out = 0;
  };

  double width_m_, mean_radius_m_, dt_s_;
  std::size_t window_;
  std::deque<Step> last_;
  std::size_t queued_steps_ = 0;  ///< of the window
  int served_ = 0;                ///< outward crossings in those
  int crossed_out_ = 0;
  bool had_queue_ = false;  ///< at the step before
};

}  // namespace throng::metrics
