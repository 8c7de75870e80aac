// Result of a calibration.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/error.h"
#include "camera/calibration/adjustment.h"
#include "camera/calibration/correspondences.h"

namespace throng::calibrate {

/// A point of a view, as it was observed and as the solution shows it.
struct PointResult {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();  ///< shown - observed (px); NaN: not shown
  bool used = true;
};

struct ViewResult {
  std::string name;
  ViewPose pose;
  /// Standard deviations of rotation (rad, about the axes of the rotation vector) and translation;
  /// NaN: undetermined.
  Eigen::Matrix<double, 6, 1> pose_sd = Eigen::Matrix<double, 6, 1>::Zero();
  std::vector<PointResult> points;
  double rms_px = 0;  ///< of used points, OpenCV's convention

  std::size_t used() const;
};

/// How well a lens model did, over the same points.
struct ModelScore {
  Lens lens = Lens::pinhole;
  std::size_t unknowns = 0;
  double rms_px = 0;
  double bic = 0;  ///< m ln(SSE / m) + p ln m (Schwarz 1978), m: numbers observed
};

struct Calibration {
  std::string kind;  ///< "intrinsics", "pose" or "bundle"
  Lens lens = Lens::brown5;
  ImageSize size;
  Parameters parameters{};
  /// Standard deviations: 0 for what was fixed, NaN for what the data leave open.
  Parameters sd{};
  std::vector<std::size_t> places;  ///< parameters that were estimated
  Eigen::MatrixXd covariance;       ///< of these, in their order; empty when undetermined
  double rms_px = 0;                ///< OpenCV's convention: sqrt(sum |r|^2 / points)
  double sigma_px = 0;       ///< of a pixel coordinate: sqrt(sum |r|^2 / (numbers - unknowns))
  std::size_t points = 0;    ///< used
  std::size_t rejected = 0;  ///< outliers
  int iterations = 0;
  bool converged = false;
  std::vector<ViewResult> views;
  std::vector<Problem> left_out;      ///< images that were not used, and why
  std::vector<std::string> warnings;  ///< what the data cannot support
  std::vector<ModelScore> models;     ///< if a model was to be chosen, the best first

  camera::Intrinsics intrinsics() const;
};

/// Fills what follows from a fitted adjustment whose poses are those of `names`: parameters, their
/// covariance (with ties), views, RMS.
struct Fit;
void take_results(const Adjustment& adjustment, const Fit& fit,
                  const std::vector<std::string>& names, Calibration& calibration);

}  // namespace throng::calibrate
