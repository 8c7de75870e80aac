// Paths of moving goals.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace throng::crowd {

/// Moves along points at constant speed: from the last one to the first (closed), or back in
/// reverse order (open). A step may pass several points.
class GoalPath {
 public:
  /// `points`: at least two, in m; if all coincide, the position is constant.
  GoalPath(std::vector<Eigen::Vector2d> points, double speed_mps, bool closed);

  void advance(double dt_s);
  Eigen::Vector2f position() const { return position_.cast<float>(); }

 private:
  void head_on();

  std::vector<Eigen::Vector2d> points_;
  double speed_mps_;
  bool closed_;
  double lap_m_ = 0;  // length of a full period, after which position and direction repeat
  Eigen::Vector2d position_;
  std::size_t next_ = 1;  // index of the next point
  bool forward_ = true;
};

}  // namespace throng::crowd
