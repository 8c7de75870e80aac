#include "camera/distortion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"

namespace throng::camera {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

constexpr double kMaxAngle = 80 * kDegree;
constexpr double kNearAxis = 1e-9;
constexpr double kConverged = 1e-13;

/// Value and derivative by s of 1 + a s + b s^2 + c s^3 + d s^4.
struct Series {
  double value;
  double slope;
};

Series series(double s, double a, double b, double c, double d = 0) {
  return {1 + s * (a + s * (b + s * (c + s * d))), a + s * (2 * b + s * (3 * c + s * 4 * d))};
}

}  // namespace

Distortion::Distortion(Model model, const Coefficients& coefficients)
    : model_(model),
      coefficients_(coefficients),
      limit_(find_limit()),
      max_shown_(radial(limit_).shown) {}

Distortion::Radial Distortion::radial(double r) const {
  const Coefficients& k = coefficients_;
  if (model_ == Model::fisheye) {
    const double theta = std::atan(r);
    const double s = theta * theta;
    const Series c = series(s, k[0], k[1], k[2], k[3]);
    return {theta * c.value, (c.value + 2 * s * c.slope) / (1 + r * r)};
  }
  const double s = r * r;
  const Series above = series(s, k[0], k[1], k[4]);
  const Series below = series(s, k[5], k[6], k[7]);
  const double c = above.value / below.value;
  const double c_slope = (above.slope - c * below.slope) / below.value;
  return {r * c, c + 2 * s * c_slope};
}

double Distortion::find_limit() const {
  // A pole of the rational model makes the slope negative or huge on one of its sides; steps this
  // small see the change of sign of any lens that somebody would calibrate.
  constexpr int kSteps = 4096;
  const double widest = std::tan(kMaxAngle);
  double good = 0;
  double before = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double r = widest * i / kSteps;
    const Radial here = radial(r);
    // Written so that NaN ends it, too.
    if (!(here.slope > 0 && here.shown > before)) {
      double bad = r;
      while (bad - good > kNearAxis) {
        const double middle = 0.5 * (good + bad);
        (radial(middle).slope > 0 ? good : bad) = middle;
      }
      return good;
    }
    good = r;
    before = here.shown;
  }
  return widest;
}

double Distortion::inverse_radial(double shown) const {
  // Newton's steps, kept between bounds that every step tightens.
  double low = 0;
  double high = limit_;
  double r = std::min(shown, limit_);
  constexpr int kMaxSteps = 100;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Radial here = radial(r);
    const double error = here.shown - shown;
    (error > 0 ? high : low) = r;
    double next = r - error / here.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - r) < kConverged) return next;
    r = next;
  }
  return r;
}

Vector2d Distortion::apply(const Vector2d& pinhole) const {
  const double r = pinhole.norm();
  const double c = r < kNearAxis ? 1.0 : radial(r).shown / r;
  if (model_ == Model::fisheye) return c * pinhole;
  const double p1 = coefficients_[2];
  const double p2 = coefficients_[3];
  const double x = pinhole.x();
  const double y = pinhole.y();
  return {c * x + 2 * p1 * x * y + p2 * (r * r + 2 * x * x),
          c * y + p1 * (r * r + 2 * y * y) + 2 * p2 * x * y};
}

Matrix2d Distortion::derivatives(const Vector2d& pinhole) const {
  const double r = pinhole.norm();
  Matrix2d j = Matrix2d::Identity();
  if (r >= kNearAxis) {
    const Radial here = radial(r);
    const double across = here.shown / r;
    const Vector2d outwards = pinhole / r;
    j = across * j + (here.slope - across) * outwards * outwards.transpose();
  }
  if (model_ == Model::fisheye) return j;
  const double p1 = coefficients_[2];
  const double p2 = coefficients_[3];
  const double x = pinhole.x();
  const double y = pinhole.y();
  Matrix2d tangential;
  tangential << 2 * p1 * y + 6 * p2 * x, 2 * p1 * x + 2 * p2 * y, 2 * p1 * x + 2 * p2 * y,
      6 * p1 * y + 2 * p2 * x;
  return j + tangential;
}

std::optional<Vector2d> Distortion::distort(const Vector2d& pinhole) const {
  if (!(pinhole.norm() <= limit_)) return std::nullopt;
  // Tangential terms fold the image before the radial ones do, on one side.
  const bool is_tangential = coefficients_[2] != 0 || coefficients_[3] != 0;
  if (model_ == Model::brown_conrady && is_tangential &&
      !(derivatives(pinhole).determinant() > kNearAxis)) {
    return std::nullopt;
  }
  return apply(pinhole);
}

std::optional<Vector2d> Distortion::undistort(const Vector2d& distorted) const {
  const double shown = distorted.norm();
  Vector2d p = distorted;
  if (shown >= kNearAxis) p *= inverse_radial(std::min(shown, max_shown_)) / shown;
  constexpr int kMaxSteps = 20;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Vector2d error = apply(p) - distorted;
    const Matrix2d j = derivatives(p);
    const double determinant = j.determinant();
    if (!(determinant > kNearAxis)) return std::nullopt;
    const Vector2d step = j.inverse() * error;
    p -= step;
    if (!(p.norm() <= limit_)) return std::nullopt;
    if (step.norm() < kConverged) return p;
  }
  return (apply(p) - distorted).norm() < 1e-12 ? std::optional(p) : std::nullopt;
}

std::optional<Vector2d> Distortion::undistort(const Vector2d& distorted,
                                              const Vector2d& guess) const {
  constexpr int kMaxSteps = 4;
  // Each step squares the error, but for a factor near 1.
  constexpr double kLastStep = 1e-7;
  Vector2d p = guess;
  for (int i = 0; i < kMaxSteps && p.norm() <= limit_; ++i) {
    const Matrix2d j = derivatives(p);
    if (!(j.determinant() > kNearAxis)) break;
    const Vector2d step = j.inverse() * (apply(p) - distorted);
    p -= step;
    if (step.norm() < kLastStep && p.norm() <= limit_) return p;
  }
  return undistort(distorted);
}

}  // namespace throng::camera
