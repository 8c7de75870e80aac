#include "sim/vehicle/people_nearby.h"

#include "base/error.h"

namespace throng::sim {

void MovingPeople::begin(const PeopleView& end, double interval_s) {
  check(end.position.size() == end.present.size(), "everybody has a place and may be there");
  end_ = end;
  interval_s_ = interval_s;
  if (start_.size() != end.position.size()) finish();
}

void MovingPeople::finish() {
  start_.assign(end_.position.begin(), end_.position.end());
  was_present_.assign(end_.present.begin(), end_.present.end());
}

void MovingPeople::collect(const Disc& area, std::vector<NearPerson>& list) const {
  const Eigen::Vector2f center = area.center.cast<float>();
  const auto reach2 = static_cast<float>(area.radius_m * area.radius_m);
  for (std::size_t i = 0; i < start_.size(); ++i) {
    if ((start_[i] - center).squaredNorm() > reach2) continue;
    if (was_present_[i] == 0 || end_.present[i] == 0) continue;
    const Eigen::Vector2d from = start_[i].cast<double>();
    const Eigen::Vector2d offset = end_.position[i].cast<double>() - from;
    list.push_back({static_cast<int>(i), from, offset / interval_s_});
  }
}

}  // namespace throng::sim
