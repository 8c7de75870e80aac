// First guesses for a calibration: what a solver starts from.
#pragma once

#include <vector>

#include "camera/calibration/adjustment.h"
#include "camera/calibration/correspondences.h"

namespace throng::calibrate {

/// The points of a view as coordinates in their own plane; nothing if they are in none.
struct PlaneView {
  std::vector<Eigen::Vector2d> points;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: the plane's x, y and normal
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};
std::optional<PlaneView> fit_plane(const std::vector<Eigen::Vector3d>& points);

/// Maps plane to pixels (or directions): the normalized linear solution (Hartley and Zisserman
/// 2004, alg. 4.2), its weights refined so that few outliers do not count. Nothing when degenerate.
std::optional<Eigen::Matrix3d> homography(const std::vector<Eigen::Vector2d>& from,
                                          const std::vector<Eigen::Vector2d>& to);

/// Zhang's closed form (2000, appendix B) from the homographies of planar views: fx, fy, cx, cy,
/// and skew if asked for. Nothing when the views do not fix them.
std::optional<Parameters> zhang(const std::vector<Eigen::Matrix3d>& homographies, bool skew);

/// The same with the principal point given: two views, or one that is not frontal.
std::optional<Parameters> zhang_centered(const std::vector<Eigen::Matrix3d>& homographies,
                                         const Eigen::Vector2d& center);

/// The pose of a view through this lens: from the homography of a planar view, else by SQPnP.
std::optional<ViewPose> guess_pose(const View& view, const camera::Intrinsics& lens);

/// Lenses worth a try with a pose per view, the best first, what `rules` fixes being kept. A view
/// that a lens does not explain is somewhere before the camera. Empty when no lens explains more
/// than half of the views.
struct Guess {
  Parameters parameters{};
  std::vector<ViewPose> poses;
  double misfit = 0;  ///< mean of log(1 + r^2) over the points, r in pixels
};
std::vector<Guess> guesses(const Correspondences& all, Lens lens, const Rules& rules);

}  // namespace throng::calibrate
