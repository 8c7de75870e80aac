#include "calibration/initialize.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/compute/quantile.h"
#include "calibration/pnp.h"
#include "calibration/projection.h"

namespace throng::calibrate {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Moves and scales points to mean 0 and mean distance sqrt 2.
Matrix3d normalization(const std::vector<Vector2d>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) mean += p / static_cast<double>(points.size());
  double distance = 0;
  for (const Vector2d& p : points)
    distance += (p - mean).norm() / static_cast<double>(points.size());
  const double scale = distance > 0 ? std::sqrt(2.0) / distance : 1;
  Matrix3d t;
  t << scale, 0, -scale * mean.x(), 0, scale, -scale * mean.y(), 0, 0, 1;
  return t;
}

/// The vector that A'A shrinks most.
Eigen::VectorXd null_vector(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a.transpose() * a);
  return solver.eigenvectors().col(0);
}

/// Zhang's v_ij (2000, eq. 7) for columns i and j of a homography.
Eigen::Matrix<double, 1, 6> constraint(const Matrix3d& h, int i, int j) {
  Eigen::Matrix<double, 1, 6> v;
  v << h(0, i) * h(0, j), h(0, i) * h(1, j) + h(1, i) * h(0, j), h(1, i) * h(1, j),
      h(2, i) * h(0, j) + h(0, i) * h(2, j), h(2, i) * h(1, j) + h(1, i) * h(2, j),
      h(2, i) * h(2, j);
  return v;
}

Vector2d image_center(const ImageSize& size) {
  return {0.5 * (size.width - 1), 0.5 * (size.height - 1)};
}

/// Some pose before the camera, for a view that has no better one: it will turn out as wrong.
ViewPose any_pose(const View& view) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : view.points) middle += p / static_cast<double>(view.points.size());
  double radius = 0;
  for (const Vector3d& p : view.points) radius = std::max(radius, (p - middle).norm());
  constexpr double kRadiiAway = 4;
  return {Vector3d::Zero(), Vector3d(0, 0, kRadiiAway * radius) - middle};
}

/// Values that `rules` fixes replace the initial guess.
void keep_fixed(const Rules& rules, const Vector2d& center, Parameters& p) {
  for (std::size_t i = 0; i < kParameters; ++i) {
    if (rules.free[i] || rules.source[i] != i) continue;
    p[i] = !std::isnan(rules.fixed[i]) ? rules.fixed[i] : i == kCx ? center.x() : center.y();
  }
  apply_ties(rules, p);
}

ViewPose pose_of_plane(const Matrix3d& h, const PlaneView& plane) {
  Matrix3d scaled = h / (0.5 * (h.col(0).norm() + h.col(1).norm()));
  if (scaled(2, 2) < 0) scaled = -scaled;  // the plane's origin is before the camera
  Matrix3d turn;
  turn << scaled.col(0), scaled.col(1), scaled.col(0).cross(scaled.col(1));
  const Eigen::JacobiSVD<Matrix3d> svd(turn, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  camera::Pose pose;
  pose.R = nearest * plane.axes.transpose();
  pose.t = scaled.col(2) - pose.R * plane.origin;
  return to_view_pose(pose);
}

double mean_misfit(const Correspondences& all, Lens lens, const Guess& guess) {
  // A point behind the camera counts as this many pixels.
  constexpr double kBehind = 1e6;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < all.views.size(); ++v) {
    for (std::size_t i = 0; i < all.views[v].points.size(); ++i) {
      const Vector3d seen = guess.poses[v].to_camera(all.views[v].points[i]);
      Vector2d pixel;
      const bool shown =
          project(lens == Lens::fisheye, guess.parameters.data(), seen.data(), pixel.data());
      const double r = shown ? (pixel - all.views[v].pixels[i]).norm() : kBehind;
      sum += std::log1p(r * r);
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

std::optional<Guess> guess_with(const Correspondences& all, Lens lens, const Rules& rules,
                                Parameters parameters) {
  keep_fixed(rules, image_center(all.size), parameters);
  Guess guess{parameters, {}, 0};
  const camera::Intrinsics k = to_intrinsics(lens, parameters, all.size.width, all.size.height);
  std::size_t found = 0;
  for (const View& view : all.views) {
    const std::optional<ViewPose> pose = guess_pose(view, k);
    found += pose ? 1 : 0;
    guess.poses.push_back(pose ? *pose : any_pose(view));
  }
  if (2 * found <= all.views.size()) return std::nullopt;
  guess.misfit = mean_misfit(all, lens, guess);
  return guess;
}

std::vector<Parameters> lens_candidates(const Correspondences& all, Lens lens, const Rules& rules) {
  const Vector2d center = image_center(all.size);
  std::vector<Matrix3d> planes;
  for (const View& view : all.views) {
    const std::optional<PlaneView> plane = fit_plane(view.points);
    if (!plane) continue;
    if (const auto h = homography(plane->points, view.pixels)) planes.push_back(*h);
  }
  std::vector<Parameters> candidates;
  if (lens != Lens::fisheye) {
    if (const auto closed = zhang(planes, rules.free[kSkew])) candidates.push_back(*closed);
    if (const auto centered = zhang_centered(planes, center)) candidates.push_back(*centered);
  }
  // Fields of view from 16 to 150 degrees of a pinhole, or of a fisheye's arcs.
  constexpr std::array kFocalByWidth = {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 3.5};
  for (const double share : kFocalByWidth) {
    const double focal = share * std::max(all.size.width, all.size.height);
    candidates.push_back({focal, focal, center.x(), center.y()});
  }
  return candidates;
}

}  // namespace

std::optional<PlaneView> fit_plane(const std::vector<Vector3d>& points) {
  PlaneView plane;
  for (const Vector3d& p : points) plane.origin += p / static_cast<double>(points.size());
  MatrixXd all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) = points[i] - plane.origin;
  }
  const Eigen::JacobiSVD<Matrix3d> svd(all * all.transpose(), Eigen::ComputeFullU);
  const Vector3d extents = svd.singularValues().cwiseSqrt();
  constexpr double kFlat = 1e-6;
  if (!(extents[2] <= kFlat * extents[0])) return std::nullopt;
  plane.axes << svd.matrixU().col(0), svd.matrixU().col(1),
      svd.matrixU().col(0).cross(svd.matrixU().col(1));
  for (const Vector3d& p : points) {
    plane.points.push_back((plane.axes.transpose() * (p - plane.origin)).head<2>());
  }
  return plane;
}

std::optional<Matrix3d> homography(const std::vector<Vector2d>& from,
                                   const std::vector<Vector2d>& to) {
  constexpr std::size_t kMinPoints4 = 4;
  constexpr int kRounds = 4;
  if (from.size() < kMinPoints4) return std::nullopt;
  const Matrix3d before = normalization(from);
  const Matrix3d after = normalization(to);
  const auto count = static_cast<Eigen::Index>(from.size());
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(count);
  Matrix3d h = Matrix3d::Identity();
  for (int round = 0; round < kRounds; ++round) {
    MatrixXd a = MatrixXd::Zero(2 * count, 9);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Vector3d p = before * from[at].homogeneous();
      const Vector3d q = after * to[at].homogeneous();
      a.block<1, 3>(2 * i, 0) = weights[i] * p.transpose();
      a.block<1, 3>(2 * i, 6) = -weights[i] * q.x() * p.transpose();
      a.block<1, 3>(2 * i + 1, 3) = weights[i] * p.transpose();
      a.block<1, 3>(2 * i + 1, 6) = -weights[i] * q.y() * p.transpose();
    }
    const Eigen::VectorXd entries = null_vector(a);
    h << entries[0], entries[1], entries[2], entries[3], entries[4], entries[5], entries[6],
        entries[7], entries[8];
    std::vector<double> errors;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Vector3d q = h * (before * from[at].homogeneous());
      const Vector3d wanted = after * to[at].homogeneous();
      errors.push_back((q.head<2>() / q.z() - wanted.head<2>()).norm());
    }
    constexpr double kMinScale = 1e-12;
    constexpr double kFarByMedian = 3;
    const double scale = kFarByMedian * std::max(median(errors), kMinScale);
    for (Eigen::Index i = 0; i < count; ++i) {
      const double r = errors[static_cast<std::size_t>(i)] / scale;
      weights[i] = 1 / (1 + r * r);
    }
  }
  const Matrix3d result = after.inverse() * h * before;
  return result.allFinite() ? std::optional(result) : std::nullopt;
}

std::optional<Parameters> zhang(const std::vector<Matrix3d>& homographies, bool skew) {
  const std::size_t needed = skew ? 3 : 2;
  if (homographies.size() < needed) return std::nullopt;
  // Pixels of thousands would drown the small entries.
  constexpr double kPixels = 1e-3;
  const Matrix3d scale = Vector3d(kPixels, kPixels, 1).asDiagonal();
  const auto count = static_cast<Eigen::Index>(homographies.size());
  MatrixXd v = MatrixXd::Zero(2 * count + (skew ? 0 : 1), 6);
  for (Eigen::Index i = 0; i < count; ++i) {
    Matrix3d h = scale * homographies[static_cast<std::size_t>(i)];
    h /= h.leftCols<2>().norm();
    v.row(2 * i) = constraint(h, 0, 1);
    v.row(2 * i + 1) = constraint(h, 0, 0) - constraint(h, 1, 1);
  }
  if (!skew) v(2 * count, 1) = static_cast<double>(count);
  Eigen::VectorXd b = null_vector(v);
  if (b[0] < 0) b = -b;
  const double determinant = b[0] * b[2] - b[1] * b[1];
  if (!(b[0] > 0 && determinant > 0)) return std::nullopt;
  const double v0 = (b[1] * b[3] - b[0] * b[4]) / determinant;
  const double lambda = b[5] - (b[3] * b[3] + v0 * (b[1] * b[3] - b[0] * b[4])) / b[0];
  if (!(lambda > 0)) return std::nullopt;
  const double alpha = std::sqrt(lambda / b[0]);
  const double beta = std::sqrt(lambda * b[0] / determinant);
  const double gamma = skew ? -b[1] * alpha * alpha * beta / lambda : 0;
  const double u0 = gamma * v0 / beta - b[3] * alpha * alpha / lambda;
  const Parameters p{alpha / kPixels, beta / kPixels, u0 / kPixels, v0 / kPixels, gamma / kPixels};
  const bool finite = std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
  return finite ? std::optional(p) : std::nullopt;
}

std::optional<Parameters> zhang_centered(const std::vector<Matrix3d>& homographies,
                                         const Vector2d& center) {
  if (homographies.empty()) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(homographies.size());
  Matrix3d to_center = Matrix3d::Identity();
  to_center.topRightCorner<2, 1>() = -center;
  MatrixXd a(2 * count, 2);
  Eigen::VectorXd right(2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    Matrix3d h = to_center * homographies[static_cast<std::size_t>(i)];
    h /= h.leftCols<2>().norm();
    a.row(2 * i) << h(0, 0) * h(0, 1), h(1, 0) * h(1, 1);
    right[2 * i] = -h(2, 0) * h(2, 1);
    a.row(2 * i + 1) << h(0, 0) * h(0, 0) - h(0, 1) * h(0, 1),
        h(1, 0) * h(1, 0) - h(1, 1) * h(1, 1);
    right[2 * i + 1] = -(h(2, 0) * h(2, 0) - h(2, 1) * h(2, 1));
  }
  const Vector2d inverse_squares = a.colPivHouseholderQr().solve(right);
  if (!(inverse_squares.minCoeff() > 0)) return std::nullopt;
  return Parameters{1 / std::sqrt(inverse_squares.x()), 1 / std::sqrt(inverse_squares.y()),
                    center.x(), center.y()};
}

std::optional<ViewPose> guess_pose(const View& view, const camera::Intrinsics& lens) {
  std::vector<Vector3d> points;
  std::vector<Vector2d> directions;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    const std::optional<Vector2d> direction = lens.direction_of(view.pixels[i]);
    if (!direction) continue;  // the model ends before: others will do
    points.push_back(view.points[i]);
    directions.push_back(*direction);
  }
  const std::optional<PlaneView> plane = points.empty() ? std::nullopt : fit_plane(points);
  if (!plane) return pose_from_directions(points, directions);
  const std::optional<Matrix3d> h = homography(plane->points, directions);
  if (!h) return std::nullopt;
  const ViewPose pose = pose_of_plane(*h, *plane);
  const bool before = std::all_of(view.points.begin(), view.points.end(),
                                  [&](const Vector3d& p) { return pose.to_camera(p).z() > 0; });
  return before && pose.rotation.allFinite() ? std::optional(pose) : std::nullopt;
}

std::vector<Guess> guesses(const Correspondences& all, Lens lens, const Rules& rules) {
  std::vector<Guess> good;
  for (const Parameters& candidate : lens_candidates(all, lens, rules)) {
    if (std::optional<Guess> guess = guess_with(all, lens, rules, candidate)) {
      good.push_back(std::move(*guess));
    }
  }
  std::stable_sort(good.begin(), good.end(),
                   [](const Guess& a, const Guess& b) { return a.misfit < b.misfit; });
  return good;
}

}  // namespace throng::calibrate
