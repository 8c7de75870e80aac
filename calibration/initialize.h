// Initial guesses for the solver of a calibration.
#pragma once

#include <vector>

#include "calibration/adjustment.h"
#include "calibration/correspondences.h"

namespace throng::calibrate {

/// The points of a planar view, as coordinates in their plane.
struct PlaneView {
  std::vector<Eigen::Vector2d> points;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: the plane's x, y and normal
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};
/// The plane through the points, or nothing if they are not coplanar.
std::optional<PlaneView> fit_plane(const std::vector<Eigen::Vector3d>& points);

/// The homography from a plane to pixels (or directions): the normalized linear solution (Hartley
/// and Zisserman 2004, alg. 4.2), iteratively reweighted against outliers. Nothing if degenerate.
std::optional<Eigen::Matrix3d> homography(const std::vector<Eigen::Vector2d>& from,
                                          const std::vector<Eigen::Vector2d>& to);

/// Zhang's closed form (2000, appendix B) of fx, fy, cx, cy and, if `skew`, the skew, from the
/// homographies of planar views. Nothing if the views do not determine them.
std::optional<Parameters> zhang(const std::vector<Eigen::Matrix3d>& homographies, bool skew);

/// As zhang(), with the principal point given and without skew: needs two views, or one that is not
/// frontal.
std::optional<Parameters> zhang_centered(const std::vector<Eigen::Matrix3d>& homographies,
                                         const Eigen::Vector2d& center);

/// The pose of a view with this lens: from the homography of a planar view, else by SQPnP.
std::optional<ViewPose> guess_pose(const View& view, const camera::Intrinsics& lens);

/// Initial lens parameters with a pose per view.
struct Guess {
  Parameters parameters{};
  std::vector<ViewPose> poses;
  double misfit = 0;  ///< mean of log(1 + r^2) over the points, r in pixels
};
/// Candidates for the solver, the best first; values that `rules` fix are kept. A view that a lens
/// does not explain gets some pose in front of the camera. Empty if no lens explains more than half
/// of the views.
std::vector<Guess> guesses(const Correspondences& all, Lens lens, const Rules& rules);

}  // namespace throng::calibrate
