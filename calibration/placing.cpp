#include "calibration/placing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "calibration/pnp.h"

namespace throng::calibrate {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Median distance (px) between where a pose shows the sightings and where they are.
double median_miss(const std::vector<Sighting>& sightings, const camera::Camera& camera) {
  std::vector<double> misses;
  for (const Sighting& sighting : sightings) {
    const camera::Camera::Projection shown = camera.project(sighting.point);
    misses.push_back(shown.visible ? (shown.pixel - sighting.pixel).norm()
                                   : std::numeric_limits<double>::infinity());
  }
  const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
  std::nth_element(misses.begin(), middle, misses.end());
  return *middle;
}

std::optional<ViewPose> estimate_pose(const std::vector<Sighting>& sightings,
                                      const std::vector<Vector2d>& directions,
                                      const std::vector<std::size_t>& chosen) {
  std::vector<Vector3d> points;
  std::vector<Vector2d> seen;
  for (const std::size_t i : chosen) {
    points.push_back(sightings[i].point);
    seen.push_back(directions[i]);
  }
  return pose_from_directions(points, seen);
}

/// `count` different numbers below `total`.
std::vector<std::size_t> draw(Random& random, std::size_t count, std::size_t total) {
  std::vector<std::size_t> chosen;
  while (chosen.size() < count) {
    const std::size_t next = random.below(static_cast<std::uint32_t>(total));
    if (std::find(chosen.begin(), chosen.end(), next) == chosen.end()) chosen.push_back(next);
  }
  return chosen;
}

}  // namespace

std::optional<ViewPose> resect(const std::vector<Sighting>& all, const camera::Intrinsics& lens) {
  std::vector<Sighting> sightings;
  std::vector<Vector2d> directions;
  for (const Sighting& sighting : all) {
    const std::optional<Vector2d> direction = lens.direction_of(sighting.pixel);
    if (!direction) continue;
    sightings.push_back(sighting);
    directions.push_back(*direction);
  }
  constexpr std::size_t kMinSightings = 4;
  if (sightings.size() < kMinSightings) return std::nullopt;
  std::vector<std::size_t> everything(sightings.size());
  for (std::size_t i = 0; i < everything.size(); ++i) everything[i] = i;
  std::optional<ViewPose> best;
  double min_miss = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::optional<ViewPose>& pose) {
    if (!pose) return;
    const double miss = median_miss(sightings, {lens, pose->pose()});
    if (best && !(miss < min_miss)) return;
    best = pose;
    min_miss = miss;
  };
  consider(estimate_pose(sightings, directions, everything));
  // With five of six right, 60 subsets of five miss an all-right one once in 10^13.
  constexpr std::size_t kSubset = 5;
  constexpr std::uint64_t kSubsets = 60;
  if (sightings.size() > kSubset) {
    for (std::uint64_t i = 0; i < kSubsets; ++i) {
      Random random(sightings.size(), Stream::bootstrap, i);
      consider(estimate_pose(sightings, directions, draw(random, kSubset, sightings.size())));
    }
  }
  return best;
}

std::optional<Vector3d> intersect(const std::vector<Ray>& rays, const camera::Intrinsics& lens) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  std::vector<Vector3d> directions;
  for (const Ray& ray : rays) {
    const std::optional<Vector2d> seen = lens.direction_of(ray.pixel);
    if (!seen) continue;
    const Vector3d direction = (ray.pose.R.transpose() * seen->homogeneous()).normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - direction * direction.transpose();
    sum += across;
    right += across * ray.pose.center();
    directions.push_back(direction);
  }
  constexpr double kMinWidth = kDegree;
  double widest = 0;
  for (const Vector3d& a : directions) {
    for (const Vector3d& b : directions) widest = std::max(widest, a.cross(b).norm());
  }
  if (widest < std::sin(kMinWidth)) return std::nullopt;
  const Vector3d point = sum.ldlt().solve(right);
  const bool before = std::all_of(rays.begin(), rays.end(), [&](const Ray& ray) {
    return (ray.pose.R * point + ray.pose.t).z() > 0;
  });
  return before && point.allFinite() ? std::optional(point) : std::nullopt;
}

}  // namespace throng::calibrate
