// Half-planes of permitted velocities, and the optimal velocity in their intersection: the last
// step of ORCA and related models (van den Berg et al. 2011).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace throng::crowd {

/// The boundary of a half-plane of permitted velocities, which are to the left of the direction.
struct HalfPlane {
  Eigen::Vector2f point;
  Eigen::Vector2f direction;  ///< unit
};

/// A list of half-planes as a structure of arrays, for vectorized kernels.
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

  /// Changes the number of half-planes; new ones are uninitialized. Arrays have padding, so kernels
  /// may load and store whole vectors that begin before the end.
  void resize(std::size_t count);
  /// Reserves memory for `count` half-planes.
  void reserve(std::size_t count);

  std::vector<float> point_x;
  std::vector<float> point_y;
  std::vector<float> direction_x;
  std::vector<float> direction_y;

 private:
  std::size_t size_ = 0;
};

/// Returns the velocity nearest to `preferred`, of at most `max_speed`, in all half-planes. If
/// there is none, keeps the first `hard` half-planes and minimizes the max violation of the others.
/// `scratch` is a reusable buffer.
Eigen::Vector2f best_velocity(const HalfPlanes& planes, std::size_t hard,
                              const Eigen::Vector2f& preferred, float max_speed,
                              HalfPlanes& scratch);

}  // namespace throng::crowd
