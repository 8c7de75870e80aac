#include "calibration/pose.h"

#include <fmt/core.h>

#include <Eigen/SVD>
#include <algorithm>
#include <map>
#include <set>

#include "calibration/placing.h"
#include "calibration/warnings.h"

namespace throng::calibrate {

using Eigen::Vector3d;

namespace {

constexpr std::size_t kMinControlPoints = 4;

/// Pixels by image, in the order of the file; points by name.
struct Images {
  std::vector<std::string> names;
  std::map<std::string, std::vector<NamedPixel>> pixels;
};

Images split_by_image(const std::vector<NamedPixel>& pixels) {
  Images images;
  for (const NamedPixel& seen : pixels) {
    auto& list = images.pixels[seen.image];
    if (list.empty()) images.names.push_back(seen.image);
    list.push_back(seen);
  }
  return images;
}

/// Middle of the control points: maps' coordinates of millions of meters lose digits.
Vector3d center_of_points(const ControlPoints& points) {
  Vector3d middle = Vector3d::Zero();
  for (const auto& [name, point] : points) {
    middle += point.position / static_cast<double>(points.size());
  }
  return middle;
}

/// State that grows while images and points are placed.
class Bundle {
 public:
  Bundle(const CameraFile& camera, const ControlPoints& control_points, Images images)
      : camera_(camera), images_(std::move(images)), middle_(center_of_points(control_points)) {
    for (const auto& [name, point] : control_points) {
      const Vector3d position = point.position - middle_;
      known_[name] = {position, point.sd_m, position};
    }
  }

  /// Places images that see at least `fewest` known points. Whether there was any.
  bool place_images(std::size_t fewest) {
    bool any = false;
    for (const std::string& name : images_.names) {
      if (poses_.count(name) > 0) continue;
      std::vector<Sighting> sightings;
      for (const NamedPixel& seen : images_.pixels[name]) {
        const auto found = known_.find(seen.point);
        if (found != known_.end()) sightings.push_back({found->second.position, seen.pixel});
      }
      if (sightings.size() < fewest) continue;
      const std::optional<ViewPose> pose = resect(sightings, camera_.intrinsics());
      if (!pose) continue;
      poses_[name] = *pose;
      any = true;
    }
    return any;
  }

  /// Places points that at least two placed images see.
  void place_points() {
    std::map<std::string, std::vector<Ray>> rays;
    for (const auto& [name, pose] : poses_) {
      for (const NamedPixel& seen : images_.pixels[name]) {
        if (known_.count(seen.point) == 0) rays[seen.point].push_back({pose.pose(), seen.pixel});
      }
    }
    for (const auto& [name, list] : rays) {
      if (list.size() < 2) continue;
      const std::optional<Vector3d> at = intersect(list, camera_.intrinsics());
      if (at) known_[name] = {*at, std::nullopt, *at};
    }
  }

  /// All that has been placed.
  Adjustment adjustment() {
    Adjustment result;
    result.lens = camera_.lens;
    result.parameters = camera_.parameters;
    std::map<std::string, std::size_t> place;
    for (const std::string& name : images_.names) {
      const auto pose = poses_.find(name);
      if (pose == poses_.end()) continue;
      for (const NamedPixel& seen : images_.pixels[name]) {
        const auto point = known_.find(seen.point);
        if (point == known_.end()) continue;
        const auto [at, is_new] = place.emplace(seen.point, result.points.size());
        if (is_new) result.points.push_back(point->second);
        result.observations.push_back({result.poses.size(), at->second, seen.pixel, true});
      }
      result.poses.push_back(pose->second);
    }
    return result;
  }

  std::vector<std::string> placed_images() const {
    std::vector<std::string> names;
    for (const std::string& name : images_.names) {
      if (poses_.count(name) > 0) names.push_back(name);
    }
    return names;
  }

  std::vector<Problem> left_out(const std::string& expected) const {
    std::vector<Problem> problems;
    for (const std::string& name : images_.names) {
      if (poses_.count(name) > 0) continue;
      const auto& pixels = images_.pixels.at(name);
      const auto seen = std::count_if(pixels.begin(), pixels.end(), [&](const NamedPixel& pixel) {
        return known_.count(pixel.point) > 0;
      });
      problems.push_back({name.empty() ? "image" : name, "",
                          fmt::format("{} known points, or none that a pose explains", seen),
                          expected});
    }
    return problems;
  }

  /// Control points that placed images see, in the world.
  std::vector<Vector3d> seen_control_points() const {
    std::set<std::string> names;
    for (const auto& [name, pose] : poses_) {
      for (const NamedPixel& seen : images_.pixels.at(name)) {
        const auto found = known_.find(seen.point);
        if (found != known_.end() && found->second.sd) names.insert(seen.point);
      }
    }
    std::vector<Vector3d> points;
    points.reserve(names.size());
    for (const std::string& name : names) points.push_back(known_.at(name).measured + middle_);
    return points;
  }

  const Vector3d& middle() const { return middle_; }

 private:
  CameraFile camera_;
  Images images_;
  Vector3d middle_;
  std::map<std::string, WorldPoint> known_;  ///< around middle_
  std::map<std::string, ViewPose> poses_;    ///< of the world around middle_
};

/// Results are of the world, not of the world around `middle`. Deviations of translations are those
/// of camera poses turned about the middle: it is where the data are.
void move_back(const Vector3d& middle, Calibration& calibration) {
  for (ViewResult& view : calibration.views) {
    view.pose.translation = view.pose.to_camera(-middle);
    for (PointResult& point : view.points) point.point += middle;
  }
}

bool in_a_line(const std::vector<Vector3d>& points) {
  if (points.size() < 3) return true;
  Eigen::MatrixXd all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = points[i];
  all.colwise() -= all.rowwise().mean().eval();
  const Vector3d extents = (all * all.transpose()).jacobiSvd().singularValues().cwiseSqrt();
  constexpr double kLine = 1e-4;
  return !(extents[1] > kLine * extents[0]);
}

void require_control_points(const Bundle& bundle, const std::string& source,
                            std::vector<Problem> left_out) {
  const std::vector<Vector3d> control = bundle.seen_control_points();
  if (!bundle.placed_images().empty() && !in_a_line(control)) return;
  Problem problem{source, "", fmt::format("{} control points in usable images", control.size()),
                  fmt::format("an image that shows at least {} control points", kMinControlPoints)};
  if (!bundle.placed_images().empty()) problem.expected = "control points beside a line";
  left_out.insert(left_out.begin(), problem);
  throw InputError(left_out);
}

Calibration finish(const char* kind, const CameraFile& camera, Bundle& bundle,
                   Adjustment& adjustment, const FitOptions& fit_options,
                   std::vector<Problem> left_out) {
  const Fit found = fit(adjustment, fit_options);
  Calibration result;
  result.kind = kind;
  result.size = camera.size;
  result.left_out = std::move(left_out);
  take_results(adjustment, found, bundle.placed_images(), result);
  move_back(bundle.middle(), result);
  add_control_point_warnings(bundle.seen_control_points(), found, result);
  return result;
}

Rules fixed_lens() {
  Rules rules;
  rules.ratio.fill(1);
  for (std::size_t i = 0; i < kParameters; ++i) rules.source[i] = i;
  return rules;
}

}  // namespace

Calibration calibrate_pose(const CameraFile& camera, const ControlPoints& control_points,
                           const std::vector<NamedPixel>& pixels, const PoseOptions& options) {
  Bundle bundle(camera, control_points, split_by_image(pixels));
  bundle.place_images(kMinControlPoints);
  const std::vector<Problem> left_out =
      bundle.left_out(fmt::format("at least {} control points", kMinControlPoints));
  require_control_points(bundle, options.source, left_out);
  Adjustment adjustment = bundle.adjustment();
  adjustment.rules = fixed_lens();
  return finish("pose", camera, bundle, adjustment, options.fit, left_out);
}

Calibration adjust_bundle(const CameraFile& start, const ControlPoints& control_points,
                          const std::vector<NamedPixel>& pixels, const BundleOptions& options) {
  Bundle bundle(start, control_points, split_by_image(pixels));
  // By control points first; then by what these images have fixed, which is less sure.
  constexpr std::size_t kMinOthers = 6;
  bool any = bundle.place_images(kMinControlPoints);
  while (any) {
    bundle.place_points();
    any = bundle.place_images(kMinOthers);
  }
  const std::vector<Problem> left_out = bundle.left_out(fmt::format(
      "{} control points, or {} points that other images fix", kMinControlPoints, kMinOthers));
  require_control_points(bundle, options.source, left_out);
  Adjustment adjustment = bundle.adjustment();
  adjustment.rules = options.fix_lens
                         ? fixed_lens()
                         : calibration_rules(start.lens, options.settings, options.source);
  for (std::size_t i = 0; i < kParameters && !options.fix_lens; ++i) {
    const auto fixed = options.settings.fixed.find(parameter_name(start.lens, i));
    if (fixed != options.settings.fixed.end() && fixed->second)
      adjustment.parameters[i] = *fixed->second;
  }
  apply_ties(adjustment.rules, adjustment.parameters);
  return finish("bundle", start, bundle, adjustment, options.fit, left_out);
}

}  // namespace throng::calibrate
