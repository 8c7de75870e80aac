#include "crowd/models/half_planes.h"

#include <algorithm>

#include "crowd/models/plane_lanes.h"

namespace throng::crowd {

namespace {

constexpr std::size_t kPadding = 8;  // lanes

template <typename Planes>
auto rows(Planes& planes) {
  using Number = std::remove_pointer_t<decltype(planes.point_x.data())>;
  return PlaneRowsOf<Number>{planes.point_x.data(), planes.point_y.data(),
                             planes.direction_x.data(), planes.direction_y.data(), 1};
}

}  // namespace

HalfPlanes::HalfPlanes(std::initializer_list<HalfPlane> planes) {
  for (const HalfPlane& plane : planes) push_back(plane);
}

void HalfPlanes::push_back(const HalfPlane& plane) {
  resize(size_ + 1);
  set(size_ - 1, plane);
}

void HalfPlanes::resize(std::size_t count) {
  if (count + kPadding > point_x.size()) reserve(2 * count);
  size_ = count;
}

void HalfPlanes::reserve(std::size_t count) {
  for (std::vector<float>* values : {&point_x, &point_y, &direction_x, &direction_y}) {
    values->resize(std::max(values->size(), count + kPadding));
  }
}

Eigen::Vector2f best_velocity(const HalfPlanes& planes, std::size_t hard,
                              const Eigen::Vector2f& preferred, float max_speed,
                              HalfPlanes& scratch) {
  scratch.resize(planes.size());
  const auto v =
      PlaneSolver<float>::solve(rows(planes), planes.size(), static_cast<float>(hard),
                                {preferred.x(), preferred.y()}, max_speed, rows(scratch));
  return {v.x, v.y};
}

}  // namespace throng::crowd
