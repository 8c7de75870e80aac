// An agent's stay in a trace as far as its body's motion depends on it: how far it has come when,
// and when it stands, gets on or lies.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace throng::skinning {

/// Direction of an object in the sky that attracts attention.
enum class Gaze : std::uint8_t { none, ahead, left, right };

/// An agent at one step of the crowd.
struct Moment {
  Eigen::Vector2f position = Eigen::Vector2f::Zero();  ///< m
  float yaw_rad = 0;
  bool panicked = false;
  bool down = false;  ///< cannot stand
  Gaze gaze = Gaze::none;
};

enum class Activity : std::uint8_t { standing, moving, lying };

/// Steps `first` to `last`; the next stretch begins where this one ends.
struct Stretch {
  Activity activity = Activity::standing;
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Points in time are steps, fractions included; between steps everything is linear, as it is
/// rendered.
class Trajectory {
 public:
  /// Throws nothing; `moments` must outlive this and hold at least one.
  Trajectory(std::span<const Moment> moments, double dt_s);

  std::span<const Moment> moments() const { return moments_; }
  double dt_s() const { return dt_s_; }
  std::size_t last() const { return moments_.size() - 1; }

  /// Distance walked since the first step.
  double distance_m(double step) const;
  /// When that distance was first passed, within `first` to `last`.
  double step_at(double distance_m, std::size_t first, std::size_t last) const;
  /// Mean speed over a part of the path.
  double speed_mps(double from_m, double to_m, std::size_t first, std::size_t last) const;

  const std::vector<Stretch>& stretches() const { return stretches_; }
  std::vector<float> take_distances() && { return std::move(distance_m_); }

 private:
  bool stands_at(std::size_t step) const;
  void find_stretches();

  std::span<const Moment> moments_;
  double dt_s_;
  std::vector<float> distance_m_;
  std::vector<Stretch> stretches_;
};

/// Linear between the values at whole steps.
double at_step(std::span<const float> values, double step);

}  // namespace throng::skinning
