// The result of a calibration.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/error.h"
#include "calibration/adjustment.h"
#include "calibration/correspondences.h"

namespace throng::calibrate {

/// A point of a view: its world position, its observed pixel, and the residual of the solution.
struct PointResult {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  /// Projected - observed (px); NaN: not projected.
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  bool used = true;
};

/// The result for one image.
struct ViewResult {
  std::string name;
  ViewPose pose;
  /// Standard deviations of the rotation vector (rad) and the translation; NaN: undetermined.
  Eigen::Matrix<double, 6, 1> pose_sd = Eigen::Matrix<double, 6, 1>::Zero();
  std::vector<PointResult> points;
  double rms_px = 0;  ///< of used points, by OpenCV's convention (as Calibration::rms_px)

  std::size_t used() const;
};

/// Quality of the fit of a lens model; all models are fitted to the same points.
struct ModelScore {
  Lens lens = Lens::pinhole;
  std::size_t unknowns = 0;
  double rms_px = 0;
  double bic = 0;  ///< m ln(SSE / m) + p ln m (Schwarz 1978), m coordinates, p unknowns
};

/// A calibration of any kind.
struct Calibration {
  std::string kind;  ///< "intrinsics", "pose" or "bundle"
  Lens lens = Lens::brown5;
  ImageSize size;
  Parameters parameters{};
  /// Standard deviations: 0 for fixed parameters, NaN for those that the data do not determine.
  Parameters sd{};
  std::vector<std::size_t> places;  ///< indices of the estimated parameters
  Eigen::MatrixXd covariance;       ///< of the parameters in `places`; empty if undetermined
  double rms_px = 0;                ///< by OpenCV's convention: sqrt(sum |r|^2 / points)
  double sigma_px = 0;       ///< of a pixel coordinate: sqrt(sum |r|^2 / (equations - unknowns))
  std::size_t points = 0;    ///< number of used points
  std::size_t rejected = 0;  ///< number of outliers
  int iterations = 0;
  bool converged = false;
  std::vector<ViewResult> views;
  std::vector<Problem> left_out;      ///< images that were not used, and why
  std::vector<std::string> warnings;  ///< results that the data do not support
  std::vector<ModelScore> models;     ///< candidates if the lens model was chosen, best first

  camera::Intrinsics intrinsics() const;
};

struct Fit;
/// Sets the members of `calibration` that follow from a fitted adjustment: parameters, their
/// covariance (with ties), views, RMS. `names` are the names of the adjustment's views.
void take_results(const Adjustment& adjustment, const Fit& fit,
                  const std::vector<std::string>& names, Calibration& calibration);

}  // namespace throng::calibrate
