#include "calibration/warnings.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/angle.h"
#include "calibration/initialize.h"
#include "calibration/repeated_views.h"

namespace throng::calibrate {

namespace {

constexpr std::size_t kEnoughViews = 10;

void warn(Calibration& calibration, std::string text) {
  calibration.warnings.push_back(std::move(text));
}

/// Largest angle (rad) between the normals of two planar views in the camera's frame; nothing if a
/// view is not planar.
std::optional<double> spread_of_tilts(const Calibration& calibration) {
  std::vector<Eigen::Vector3d> normals;
  for (const ViewResult& view : calibration.views) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(view.points.size());
    for (const PointResult& point : view.points) points.push_back(point.point);
    const std::optional<PlaneView> plane = fit_plane(points);
    if (!plane) return std::nullopt;
    normals.emplace_back(view.pose.pose().R * plane->axes.col(2));
  }
  double max_angle_rad = 0;
  for (const Eigen::Vector3d& a : normals) {
    for (const Eigen::Vector3d& b : normals) {
      max_angle_rad = std::max(max_angle_rad, std::acos(std::min(1.0, std::abs(a.dot(b)))));
    }
  }
  return max_angle_rad;
}

void warn_of_views(const Rules& rules, Calibration& calibration) {
  const std::size_t views = calibration.views.size();
  if (views < kEnoughViews) {
    warn(calibration,
         fmt::format(
             "{} views: with fewer than {} the lens depends much on each; take more, or give "
             "priors (--prior cx={:.0f}:20)",
             views, kEnoughViews, 0.5 * (calibration.size.width - 1)));
  }
  constexpr double kFlatDeg = 15;
  const bool focal_free = rules.free[kFx] || rules.free[kFy];
  const std::optional<double> tilts = spread_of_tilts(calibration);
  if (focal_free && tilts && *tilts * (1 / kDegree) < kFlatDeg) {
    warn(calibration,
         fmt::format(
             "the boards' planes differ by at most {:.1f} degrees: focal lengths and distances "
             "cannot be separated; tilt the board by 30 to 45 degrees in several directions",
             *tilts * (1 / kDegree)));
  }
  constexpr double kThin = 0.4;
  const double coverage = image_coverage(calibration);
  if (coverage < kThin) {
    warn(calibration, fmt::format("points cover {:.0f} % of the image: outside of them the lens is "
                                  "extrapolated; show the board near borders and corners, too",
                                  100 * coverage));
  }
}

void warn_of_repeated_views(Calibration& calibration) {
  std::vector<View> views;
  for (const ViewResult& result : calibration.views) {
    View& view = views.emplace_back();
    for (const PointResult& point : result.points) {
      view.points.push_back(point.point);
      view.pixels.push_back(point.pixel);
    }
  }
  const std::size_t repeated = views.size() - distinct_views(views);
  if (repeated == 0) return;
  warn(calibration,
       fmt::format("{} of {} views show the object where another view shows it: they add nothing, "
                   "and standard deviations come out too small",
                   repeated, views.size()));
}

// Symptoms of a wrong image size.
void warn_of_size(Calibration& calibration) {
  std::size_t outside = 0;
  for (const ViewResult& view : calibration.views) {
    for (const PointResult& point : view.points) {
      outside += is_outside(point.pixel, calibration.size) ? 1 : 0;
    }
  }
  if (outside > 0) {
    warn(calibration,
         fmt::format("{} points lie outside of an image of {} x {}: is the size right?", outside,
                     calibration.size.width, calibration.size.height));
  }
  constexpr double kFarFromMiddle = 0.15;  // of the side
  const auto far = [&](double center, int side) {
    return std::abs(center - 0.5 * (side - 1)) > kFarFromMiddle * side;
  };
  const double cx = calibration.parameters[kCx];
  const double cy = calibration.parameters[kCy];
  if (far(cx, calibration.size.width) || far(cy, calibration.size.height)) {
    warn(calibration,
         fmt::format("the principal point ({:.0f}, {:.0f}) is far from the middle of an "
                     "image of {} x {}: is the size right, or the image cropped?",
                     cx, cy, calibration.size.width, calibration.size.height));
  }
}

void warn_of_parameters(const Fit& fit, Calibration& calibration) {
  std::vector<std::string> open;
  open.reserve(fit.derivatives.undetermined.size());
  for (const std::size_t place : fit.derivatives.undetermined) {
    open.push_back(parameter_name(calibration.lens, place));
  }
  if (!open.empty()) {
    warn(calibration,
         fmt::format("the data leave {} open: fix them (--fix), tie them (--tie) or give "
                     "priors (--prior)",
                     fmt::join(open, ", ")));
  }
  constexpr double kLooseFocal = 0.02;
  constexpr double kLooseCenterPx = 0.02;  // of the width
  for (const std::size_t place : calibration.places) {
    const double sd = calibration.sd.at(place);
    const std::string name = parameter_name(calibration.lens, place);
    const double value = calibration.parameters.at(place);
    if ((place == kFx || place == kFy) && sd > kLooseFocal * value) {
      warn(calibration, fmt::format("{} is known to {:.1f} % only", name, 100 * sd / value));
    }
    if ((place == kCx || place == kCy) && sd > kLooseCenterPx * calibration.size.width) {
      warn(calibration, fmt::format("{} is known to {:.1f} px only", name, sd));
    }
    if (place >= kCoefficients && std::abs(value) < sd) {
      warn(calibration,
           fmt::format(
               "{} = {:.2g} does not differ significantly from 0 (standard deviation {:.2g}): a "
               "lens with fewer coefficients may do",
               name, value, sd));
    }
  }
}

void warn_of_outliers(Calibration& calibration) {
  constexpr double kMany = 0.05;
  const auto all = static_cast<double>(calibration.points + calibration.rejected);
  if (static_cast<double>(calibration.rejected) > kMany * all) {
    warn(calibration, fmt::format("{} of {} points were taken for outliers: look at the residuals",
                                  calibration.rejected, all));
  }
  if (!calibration.converged) warn(calibration, "the solver ended before it converged");
}

/// Whether the lens holds along the image's border.
bool holds_at_border(const Calibration& calibration) {
  const camera::Intrinsics k = calibration.intrinsics();
  constexpr int kSteps = 32;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = (k.width - 1.0) * i / kSteps;
    const double y = (k.height - 1.0) * i / kSteps;
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(x, 0), Eigen::Vector2d(x, k.height - 1.0), Eigen::Vector2d(0, y),
          Eigen::Vector2d(k.width - 1.0, y)}) {
      if (!k.direction_of(pixel)) return false;
    }
  }
  return true;
}

}  // namespace

Coverage covered_cells(const Calibration& calibration) {
  constexpr double kHalfPixel = 0.5;
  Coverage covered{};
  for (const ViewResult& view : calibration.views) {
    for (const PointResult& point : view.points) {
      const double column =
          std::floor((point.pixel.x() + kHalfPixel) * kCoverageColumns / calibration.size.width);
      const double row =
          std::floor((point.pixel.y() + kHalfPixel) * kCoverageRows / calibration.size.height);
      if (!point.used || column < 0 || row < 0 || column >= kCoverageColumns ||
          row >= kCoverageRows) {
        continue;
      }
      covered.at(static_cast<std::size_t>(row) * kCoverageColumns +
                 static_cast<std::size_t>(column)) = true;
    }
  }
  return covered;
}

double image_coverage(const Calibration& calibration) {
  const Coverage covered = covered_cells(calibration);
  return static_cast<double>(std::count(covered.begin(), covered.end(), true)) /
         static_cast<double>(covered.size());
}

void add_intrinsics_warnings(const Rules& rules, const Fit& fit, Calibration& calibration) {
  warn_of_views(rules, calibration);
  warn_of_repeated_views(calibration);
  warn_of_size(calibration);
  warn_of_parameters(fit, calibration);
  warn_of_outliers(calibration);
  if (!holds_at_border(calibration)) {
    warn(calibration,
         "the lens's model folds or ends (at most 80 degrees off its axis) within the image: "
         "rendered images are black beyond; take views with points near the borders, or a lens "
         "with fewer "
         "coefficients, if the real camera shows more");
  }
}

void add_control_point_warnings(const std::vector<Eigen::Vector3d>& control_points, const Fit& fit,
                                Calibration& calibration) {
  const std::size_t count = control_points.size();
  if (count < kEnoughControlPoints) {
    warn(calibration, fmt::format("{} control points: with fewer than {} the pose is unreliable",
                                  count, kEnoughControlPoints));
  }
  Eigen::MatrixXd all(3, count);
  for (std::size_t i = 0; i < count; ++i) all.col(static_cast<Eigen::Index>(i)) = control_points[i];
  all.colwise() -= all.rowwise().mean().eval();
  const Eigen::Vector3d extents = (all * all.transpose()).jacobiSvd().singularValues().cwiseSqrt();
  constexpr double kNearlyLine = 0.05;
  if (extents[1] < kNearlyLine * extents[0]) {
    warn(calibration, "the control points are nearly in a line: turning about it is barely fixed");
  }
  constexpr double kThin = 0.15;
  if (image_coverage(calibration) < kThin && count >= kEnoughControlPoints) {
    warn(calibration, "the control points are in a small part of the image");
  }
  if (!fit.derivatives.poses_determined) {
    warn(calibration, "the points leave the pose of at least one view open");
  }
  warn_of_outliers(calibration);
}

}  // namespace throng::calibrate
