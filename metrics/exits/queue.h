// The queue in front of an exit.
#pragma once

#include <deque>
#include <span>

#include "metrics/basis/control_zone.h"
#include "metrics/basis/near_people.h"

namespace throng::metrics {

/// The size of a queue.
struct Queue {
  int people = 0;
  /// Max path length from the exit's center along the queue to a person.
  double length_m = 0;
  /// Extent, parallel to the door, of the people of the queue who are in the control zone.
  double breadth_m = 0;
};

/// The queue consists of the people who intend the exit, are on its inner side, are slower than
/// half of their desired speed, and are connected to the control zone by links of at most 1.2 m.
/// Paths along the queue go from person to person over links, and from the first person in the zone
/// straight to the exit's center.
Queue queue_before(const ControlZone& zone, const Eigen::Vector2d& outward,
                   std::span<const NearPerson> people);

/// Predicts the wait of the last person of a queue: its size over the service rate of the door. The
/// rate is the mean of a gamma posterior: the passages during times with a queue in the last
/// kWindowS seconds, and a prior worth kPriorS seconds at the capacity of the part of the door that
/// the queue covers.
class WaitPredictor {
 public:
  static constexpr double kWindowS = 20;
  static constexpr double kPriorS = 10;

  /// For a door of this width, people of this mean radius, and steps of `dt_s`.
  WaitPredictor(const world::Exit& exit, double mean_radius_m, double dt_s);

  /// Adds a step and returns the predicted wait (s). `crossed_out`: outward crossings since the
  /// start.
  double step(const Queue& queue, int crossed_out);

 private:
  struct Step {
    bool queued = false;
    int out = 0;
  };

  double width_m_, per_ms_, mean_radius_m_, dt_s_;
  std::size_t window_;
  std::deque<Step> last_;
  std::size_t queued_steps_ = 0;  ///< steps with a queue in the window
  int served_ = 0;                ///< outward crossings in these steps
  int crossed_out_ = 0;
  bool had_queue_ = false;  ///< at the previous step
};

}  // namespace throng::metrics
