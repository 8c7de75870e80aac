#include "calibration/pnp.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>

namespace throng::calibrate {

std::optional<ViewPose> pose_from_directions(const std::vector<Eigen::Vector3d>& points,
                                             const std::vector<Eigen::Vector2d>& directions) {
  constexpr std::size_t kMinPoses = 4;
  if (points.size() < kMinPoses || points.size() != directions.size()) return std::nullopt;
  // Around their middle: maps have coordinates of millions of meters.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) middle += p / static_cast<double>(points.size());
  std::vector<cv::Point3d> world;
  std::vector<cv::Point2d> seen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i] - middle;
    world.emplace_back(p.x(), p.y(), p.z());
    seen.emplace_back(directions[i].x(), directions[i].y());
  }
  cv::Mat rotation;
  cv::Mat translation;
  try {
    if (!cv::solvePnP(world, seen, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotation, translation,
                      false, cv::SOLVEPNP_SQPNP)) {
      return std::nullopt;
    }
  } catch (const cv::Exception&) {
    return std::nullopt;  // its report that it found nothing
  }
  ViewPose pose;
  for (int i = 0; i < 3; ++i) {
    pose.rotation[i] = rotation.at<double>(i);
    pose.translation[i] = translation.at<double>(i);
  }
  if (!pose.rotation.allFinite() || !pose.translation.allFinite()) return std::nullopt;
  pose.translation = pose.to_camera(-middle);
  const bool before = std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
    return pose.to_camera(p).z() > 0;
  });
  return before ? std::optional(pose) : std::nullopt;
}

}  // namespace throng::calibrate
