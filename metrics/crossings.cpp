#include "metrics/crossings.h"

#include <cmath>

namespace throng::metrics {

ExitLine::ExitLine(const world::Exit& exit, double margin_m)
    : middle_(exit.middle()),
      outward_(exit.outward),
      half_width_m_(0.5 * exit.width_m() + margin_m) {}

double ExitLine::beyond_m(const Eigen::Vector2d& point) const {
  return (point - middle_).dot(outward_);
}

bool ExitLine::leads_through_door(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const double from = beyond_m(a);
  const double to = beyond_m(b);
  const Eigen::Vector2d hit = a + (from / (from - to)) * (b - a);
  const Eigen::Vector2d along(outward_.y(), -outward_.x());
  return std::abs((hit - middle_).dot(along)) <= half_width_m_;
}

int CrossingCounter::step(const ExitLine& line, const Eigen::Vector2d& position, double time_s) {
  const double before_s = last_s_;
  last_s_ = time_s;
  const double beyond = line.beyond_m(position);
  if (!last_) {
    last_ = position;
    outside_ = beyond >= 0;
    return 0;
  }
  const bool is_outside = beyond >= 0;
  const double was_beyond = line.beyond_m(*last_);
  if (is_outside != (was_beyond >= 0)) {
    passed_ = is_outside != outside_ && line.leads_through_door(*last_, position);
    crossed_at_s_ = before_s + was_beyond / (was_beyond - beyond) * (time_s - before_s);
  }
  last_ = position;
  if (is_outside == outside_ || std::abs(beyond) < kHysteresisM) return 0;
  const bool counts = passed_;
  outside_ = is_outside;
  passed_ = false;
  if (!counts) return 0;
  return is_outside ? 1 : -1;
}

}  // namespace throng::metrics
