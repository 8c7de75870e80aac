#include "crowd/state/goal_path.h"

#include <cmath>

namespace throng::crowd {

GoalPath::GoalPath(std::vector<Eigen::Vector2d> points, double speed_mps, bool closed)
    : points_(std::move(points)),
      speed_mps_(speed_mps),
      closed_(closed),
      position_(points_.front()) {
  double length_m = 0;
  for (std::size_t i = 1; i < points_.size(); ++i) length_m += (points_[i] - points_[i - 1]).norm();
  lap_m_ = closed_ ? length_m + (points_.front() - points_.back()).norm() : 2 * length_m;
}

void GoalPath::advance(double dt_s) {
  if (lap_m_ <= 0) return;
  // Whole laps change nothing, so that a short path and a high speed do not take long to follow.
  double left_m = std::fmod(speed_mps_ * dt_s, lap_m_);
  while (left_m > 0) {
    const Eigen::Vector2d way = points_[next_] - position_;
    const double distance_m = way.norm();
    if (distance_m > left_m) {
      position_ += (left_m / distance_m) * way;
      return;
    }
    position_ = points_[next_];
    left_m -= distance_m;
    head_on();
  }
}

void GoalPath::head_on() {
  if (closed_) {
    next_ = (next_ + 1) % points_.size();
    return;
  }
  if (forward_ && next_ + 1 == points_.size()) forward_ = false;
  if (!forward_ && next_ == 0) forward_ = true;
  next_ += forward_ ? 1 : -1;
}

}  // namespace throng::crowd
