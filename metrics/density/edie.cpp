#include "metrics/density/edie.h"

#include <algorithm>
#include <cmath>

namespace throng::metrics {

using Eigen::Vector2d;

void EdieRegion::add_time(const ControlZone& zone, double duration_s) {
  area_m2_ = zone.area_m2();
  step_s_ = duration_s;
  duration_s_ += duration_s;
}

void EdieRegion::add_walk(const ControlZone& zone, const Vector2d& from, const Vector2d& to) {
  const double share = zone.share_of_path(from, to);
  person_s_ += share * step_s_;
  walked_m_ += share * (to - from).norm();
}

double EdieRegion::density_per_m2() const {
  return duration_s_ > 0 ? person_s_ / (area_m2_ * duration_s_) : 0;
}

double EdieRegion::flow_per_ms() const {
  return duration_s_ > 0 ? walked_m_ / (area_m2_ * duration_s_) : 0;
}

double EdieRegion::speed_mps() const { return person_s_ > 0 ? walked_m_ / person_s_ : 0; }

}  // namespace throng::metrics
