#include "metrics/basis/crossings.h"

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
  return std::abs(along_m(hit)) <= half_width_m_;
}

bool ExitLine::is_in_doorway(const Eigen::Vector2d& point) const {
  return std::abs(along_m(point)) <= half_width_m_ && std::abs(beyond_m(point)) <= kDoorwayM;
}

double ExitLine::along_m(const Eigen::Vector2d& point) const {
  return (point - middle_).dot(Eigen::Vector2d(outward_.y(), -outward_.x()));
}

int CrossingCounter::step(const ExitLine& line, const Eigen::Vector2d& position, double time_s,
                          bool is_outside_place) {
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
    const bool by_door = line.leads_through_door(*last_, position);
    has_left_ = is_outside && by_door;
    passed_ = is_outside != outside_ && by_door;
    crossed_at_s_ = before_s + was_beyond / (was_beyond - beyond) * (time_s - before_s);
  }
  last_ = position;
  const bool is_clear = std::abs(beyond) >= kHysteresisM || (is_outside && is_outside_place);
  if (is_outside == outside_ || !is_clear) return 0;
  const bool counts = passed_;
  outside_ = is_outside;
  passed_ = false;
  if (!counts) return 0;
  return is_outside ? 1 : -1;
}

int CrossingCounter::vanish() {
  if (!last_ || outside_ || !passed_) return 0;
  outside_ = true;
  passed_ = false;
  return 1;
}

}  // namespace throng::metrics
