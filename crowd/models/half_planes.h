// Half-planes of allowed velocities, and the best velocity in all of them: what ORCA and its
// relatives end with (van den Berg et al. 2011).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace throng::crowd {

/// The boundary of a half-plane of allowed velocities, which lie on the left of the direction.
struct HalfPlane {
  Eigen::Vector2f point;
  Eigen::Vector2f direction;  ///< unit
};

/// A list of half-planes, one array per number, so that kernels look at several at a time.
class HalfPlanes {
 public:
  HalfPlanes() = default;
  HalfPlanes(std::initializer_list<HalfPlane> planes);

  std::size_t size() const { return size_; }
  HalfPlane operator[](std::size_t i) const {
    return {{point_x[i], point_y[i]}, {direction_x[i], direction_y[i]}};
  }
  void set(std::size_t i, const HalfPlane& plane) {
    point_x[i] = plane.point.x();
    point_y[i] = plane.point.y();
    direction_x[i] = plane.direction.x();
    direction_y[i] = plane.direction.y();
  }
  void clear() { size_ = 0; }
  void push_back(const HalfPlane& plane);

  /// Makes them `count`; those that are new are to be written. Kernels may load and store whole
  /// vectors that begin before the end.
  void resize(std::size_t count);
  /// No allocation up to that many.
  void reserve(std::size_t count);

  std::vector<float> point_x;
  std::vector<float> point_y;
  std::vector<float> direction_x;
  std::vector<float> direction_y;

 private:
  std::size_t size_ = 0;
};

/// The velocity nearest to `preferred` with at most `max_speed` in all half-planes. When there is
/// none, the first `hard` half-planes are kept and the largest violation of the others is made as
/// small as possible. `scratch` saves allocations.
Eigen::Vector2f best_velocity(const HalfPlanes& planes, std::size_t hard,
                              const Eigen::Vector2f& preferred, float max_speed,
                              HalfPlanes& scratch);

}  // namespace throng::crowd
