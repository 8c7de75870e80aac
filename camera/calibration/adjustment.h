// The least-squares problem behind every calibration: one lens, the poses of views, points that are
// known or not, and the pixels at which the views show them. Solved by Ceres.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "spec/calibration/parameters.h"

namespace throng::calibrate {

/// World to camera: rotation as axis times angle (rad), then translation. As OpenCV's rvec, tvec.
struct ViewPose {
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::UnitZ();

  Eigen::Vector3d to_camera(const Eigen::Vector3d& world) const;
  camera::Pose pose() const;
};
ViewPose to_view_pose(const camera::Pose& pose);

/// A point of the world and how well it is known.
struct WorldPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// 0: exactly; above 0: its coordinates' standard deviation around `measured`; nothing: not at
  /// all.
  std::optional<double> sd = 0;
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();  ///< counts if sd > 0
};

struct Observation {
  std::size_t view = 0;
  std::size_t point = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool used = true;  ///< false: taken for an outlier
};

struct Adjustment {
  Lens lens = Lens::brown5;
  Rules rules;
  Parameters parameters{};
  std::vector<ViewPose> poses;
  std::vector<WorldPoint> points;
  std::vector<Observation> observations;
  /// Standard deviation of a pixel coordinate: what priors are weighed against.
  double sigma_px = 1;

  Eigen::Vector2d residual(const Observation& observation) const;  ///< shown - observed; NaN behind

  /// Numbers observed (priors included) beyond those to be found: lens, poses, points.
  std::ptrdiff_t surplus() const;
};

struct SolveOptions {
  /// Cauchy's loss with this scale (px); 0: plain least squares.
  double loss_px = 0;
  int max_iterations = 100;
  /// Ends when a step makes the cost smaller by a smaller share: parameters are then within about
  /// its root of a standard deviation.
  double tolerance = 1e-12;
  /// Asked after every step whether to go on; false ends with Cancelled.
  std::function<bool()> should_continue = {};
};

struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double cost = 0;  ///< half the sum of squares, by sigma_px, priors included
};

/// Moves parameters, poses and points to the nearest minimum over the used observations.
/// Deterministic: one thread. Throws Cancelled.
SolveReport solve(Adjustment& adjustment, const SolveOptions& options = {});

/// Derivatives at the solution.
struct Linearization {
  /// Covariance of [free lens parameters, 6 per view], in units of sigma_px = 1 px: multiply by
  /// sigma^2. Priors of parameters and points, which have their own units, are weighed by the
  /// adjustment's sigma_px. Empty when the data leave something open.
  Eigen::MatrixXd covariance;
  std::vector<std::size_t> places;  ///< of the free lens parameters in Parameters
  /// Indices of the lens parameters that the data do not determine.
  std::vector<std::size_t> undetermined;
  bool poses_determined = true;
};
Linearization linearize(const Adjustment& adjustment);

}  // namespace throng::calibrate
