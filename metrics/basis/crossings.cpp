#include "metrics/basis/crossings.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"

namespace throng::metrics {

ExitLine::ExitLine(const world::Exit& exit, double margin_from_m, double margin_to_m)
    : middle_(exit.middle()),
      outward_(exit.outward),
      min_along_m_(-0.5 * exit.length_m() - margin_from_m),
      max_along_m_(0.5 * exit.length_m() + margin_to_m) {
  if (along_m(exit.from) > along_m(exit.to)) {
    min_along_m_ = -0.5 * exit.length_m() - margin_to_m;
    max_along_m_ = 0.5 * exit.length_m() + margin_from_m;
  }
}

double ExitLine::beyond_m(const Eigen::Vector2d& point) const {
  return (point - middle_).dot(outward_);
}

bool ExitLine::leads_through_door(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const double from = beyond_m(a);
  const double to = beyond_m(b);
  const Eigen::Vector2d hit = a + (from / (from - to)) * (b - a);
  return is_in_width(along_m(hit));
}

bool ExitLine::is_in_doorway(const Eigen::Vector2d& point) const {
  return is_in_width(along_m(point)) && std::abs(beyond_m(point)) <= kDoorwayM;
}

bool ExitLine::is_just_before(const Eigen::Vector2d& point) const {
  const double along = along_m(point);
  const double beside_m = along - std::clamp(along, min_along_m_, max_along_m_);
  const double beyond = beyond_m(point);
  return beyond < 0 && std::hypot(beside_m, beyond) <= kDoorwayM;
}

double ExitLine::along_m(const Eigen::Vector2d& point) const {
  return (point - middle_).dot(Eigen::Vector2d(outward_.y(), -outward_.x()));
}

std::vector<ExitLine> exit_lines(const std::vector<world::Exit>& exits, double margin_m) {
  std::vector<ExitLine> lines;
  for (std::size_t e = 0; e < exits.size(); ++e) {
    const auto margin_at = [&](const Eigen::Vector2d& end) {
      double margin = margin_m;
      for (std::size_t other = 0; other < exits.size(); ++other) {
        if (other == e) continue;
        const double gap_m = geometry::distance_to_segment(exits[other].from, exits[other].to, end);
        margin = std::min(margin, 0.5 * gap_m);
      }
      return margin;
    };
    lines.emplace_back(exits[e], margin_at(exits[e].from), margin_at(exits[e].to));
  }
  return lines;
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
    // The line's continuation may be crossed far from the door, on the way around a building.
    if (by_door) has_left_ = is_outside;
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
