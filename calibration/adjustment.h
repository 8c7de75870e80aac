// The least-squares problem of every calibration, solved by Ceres: one lens, the poses of the
// views, known and unknown world points, and the pixels at which the views show them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "spec/calibration/parameters.h"

namespace throng::calibrate {

/// Transformation from world to camera: a rotation vector (axis times angle, rad), then a
/// translation; OpenCV's rvec and tvec.
struct ViewPose {
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::UnitZ();

  Eigen::Vector3d to_camera(const Eigen::Vector3d& world) const;
  camera::Pose pose() const;
};
ViewPose to_view_pose(const camera::Pose& pose);

/// A world point with its uncertainty.
struct WorldPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// 0: known exactly; above 0: standard deviation of the coordinates around `measured`; nothing:
  /// unknown.
  std::optional<double> sd = 0;
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();  ///< used if sd > 0
};

/// A pixel at which a view shows a point; `view` and `point` are indices into the Adjustment.
struct Observation {
  std::size_t view = 0;
  std::size_t point = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool used = true;  ///< false: classified as an outlier
};

/// The variables and the data of the problem.
struct Adjustment {
  Lens lens = Lens::brown5;
  Rules rules;
  Parameters parameters{};
  std::vector<ViewPose> poses;
  std::vector<WorldPoint> points;
  std::vector<Observation> observations;
  /// Standard deviation of a pixel coordinate, which determines the weight of pixels against
  /// priors.
  double sigma_px = 1;

  /// Projected - observed; NaN behind.
  Eigen::Vector2d residual(const Observation& observation) const;

  /// Number of equations (coordinates of used observations, priors) minus the number of unknowns
  /// (of the lens, poses and points).
  std::ptrdiff_t surplus() const;
};

struct SolveOptions {
  /// Cauchy's loss with this scale (px); 0: plain least squares.
  double loss_px = 0;
  int max_iterations = 100;
  /// Relative decrease of the cost below which the solver stops. Parameters are then within about
  /// the square root of it, in standard deviations.
  double tolerance = 1e-12;
  /// Called after every step; if it returns false, solve() throws Cancelled.
  std::function<bool()> should_continue = {};
};

struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double cost = 0;  ///< half the sum of squared residuals over sigma_px, with priors
};

/// Moves parameters, poses and points to the nearest local minimum over the used observations.
/// Uses one thread, hence is deterministic. Throws Cancelled.
SolveReport solve(Adjustment& adjustment, const SolveOptions& options = {});

/// The covariance at the solution, from its derivatives.
struct Linearization {
  /// Covariance of [free lens parameters, 6 per view] for pixel coordinates with a standard
  /// deviation of 1 px: multiply by sigma^2. Priors are weighted by the adjustment's sigma_px.
  /// Empty if the data do not determine all unknowns.
  Eigen::MatrixXd covariance;
  std::vector<std::size_t> places;  ///< indices of the free lens parameters
  /// Indices of the lens parameters that the data do not determine.
  std::vector<std::size_t> undetermined;
  bool poses_determined = true;
};
Linearization linearize(const Adjustment& adjustment);

}  // namespace throng::calibrate
