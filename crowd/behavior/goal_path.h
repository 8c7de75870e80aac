// The path of a goal that moves.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace throng::crowd {

/// From point to point at constant speed; from the last one on to the first (closed), or back the
/// way it came (open). The rest of a step after a point is spent towards the next.
class GoalPath {
 public:
  /// At least two points, in m; they may coincide, and then it rests.
  GoalPath(std::vector<Eigen::Vector2d> points, double speed_mps, bool closed);

  void advance(double dt_s);
  Eigen::Vector2f position() const { return position_.cast<float>(); }

 private:
  void head_on();

  std::vector<Eigen::Vector2d> points_;
  double speed_mps_;
  bool closed_;
  double lap_m_ = 0;  // until it is back where it was, heading the same way
  Eigen::Vector2d position_;
  std::size_t next_ = 1;  // the point that it heads for
  bool forward_ = true;
};

}  // namespace throng::crowd
