// The trajectory of an agent during a stay, the input of its motion plan: walked distance over
// time, and the stretches of standing, moving and lying.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skinning/animate/acts.h"

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
  Setting setting = Setting::alone;
};

/// Activity of an agent over a stretch.
enum class Activity : std::uint8_t { standing, moving, lying };

/// Steps `first` to `last` with one activity; the next stretch starts at `last`.
struct Stretch {
  Activity activity = Activity::standing;
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Times are steps, possibly fractional. Values are linear between steps, as in rendering.
class Trajectory {
 public:
  /// `moments` has at least one element and must outlive this object.
  Trajectory(std::span<const Moment> moments, double dt_s);

  std::span<const Moment> moments() const { return moments_; }
  double dt_s() const { return dt_s_; }
  std::size_t last() const { return moments_.size() - 1; }

  /// Distance walked since the first step.
  double distance_m(double step) const;
  /// The first step in `first` to `last` at which this distance was reached.
  double step_at(double distance_m, std::size_t first, std::size_t last) const;
  /// Mean speed between two distances, within the steps `first` to `last`.
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

/// Interpolates linearly between values at integer steps.
double at_step(std::span<const float> values, double step);

}  // namespace throng::skinning
