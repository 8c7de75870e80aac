// Lens distortion by the conventions of OpenCV (calib3d and its fisheye module), so that
// calibrations of real cameras can be used unchanged.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace throng::camera {

/// Maps normalized image coordinates (x, y) = (X / Z, Y / Z) of a point in the camera's frame to
/// distorted normalized coordinates (x', y'), to which the camera matrix is then applied.
///
/// brown_conrady (Brown 1966; with the rational denominator of OpenCV), coefficients k1, k2, p1,
/// p2, k3, k4, k5, k6, r^2 = x^2 + y^2:
///   c = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6)
///   x' = c x + 2 p1 x y + p2 (r^2 + 2 x^2),  y' = c y + p1 (r^2 + 2 y^2) + 2 p2 x y
/// fisheye (Kannala and Brandt 2006, eq. 6), coefficients k1, k2, k3, k4, theta = atan r:
///   theta' = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8)
///   (x', y') = (x, y) theta' / r
///
/// Beyond some distance r from the axis such a polynomial decreases and maps two points to one. The
/// model is valid up to that distance, and to at most 80 degrees from the axis.
class Distortion {
 public:
  enum class Model { brown_conrady, fisheye };
  /// Coefficients in the order above; the last four of a fisheye are 0.
  using Coefficients = std::array<double, 8>;

  Distortion(Model model, const Coefficients& coefficients);

  Model model() const { return model_; }
  const Coefficients& coefficients() const { return coefficients_; }
  /// Largest r for which the model is valid.
  double limit() const { return limit_; }

  /// Returns the distorted coordinates, or nothing beyond the valid range.
  std::optional<Eigen::Vector2d> distort(const Eigen::Vector2d& pinhole) const;
  /// The inverse of distort(), by Newton's method to 1e-12; nothing if no valid point is mapped to
  /// `distorted`.
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& distorted) const;
  /// As above; several times as fast if `guess`, such as the result of a neighboring pixel, is
  /// near.
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& distorted,
                                           const Eigen::Vector2d& guess) const;
  /// The Jacobian of distort(): column 0 by x, column 1 by y.
  Eigen::Matrix2d derivatives(const Eigen::Vector2d& pinhole) const;

 private:
  /// Distorted distance from the axis, and its derivative with respect to r.
  struct Radial {
    double shown;
    double slope;
  };
  Radial radial(double r) const;
  Eigen::Vector2d apply(const Eigen::Vector2d& pinhole) const;
  double find_limit() const;
  /// The r in [0, limit_] whose distorted distance is `shown`, which must be at most max_shown_.
  double inverse_radial(double shown) const;

  Model model_;
  Coefficients coefficients_;
  double limit_;
  double max_shown_;
};

}  // namespace throng::camera
