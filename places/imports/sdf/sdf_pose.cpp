#include "places/imports/sdf/sdf_pose.h"

#include <sdf/sdf.hh>

namespace throng::imports {

std::optional<Eigen::Isometry3d> resolved_pose(const sdf::SemanticPose& pose,
                                               const std::string& relative_to) {
  ignition::math::Pose3d found;
  if (!pose.Resolve(found, relative_to).empty()) return std::nullopt;
  const Eigen::Vector3d at(found.Pos().X(), found.Pos().Y(), found.Pos().Z());
  Eigen::Quaterniond turn(found.Rot().W(), found.Rot().X(), found.Rot().Y(), found.Rot().Z());
  if (!at.allFinite() || !turn.coeffs().allFinite() || turn.norm() < 0.5) return std::nullopt;
  Eigen::Isometry3d whole = Eigen::Isometry3d::Identity();
  whole.linear() = turn.normalized().toRotationMatrix();
  whole.translation() = at;
  return whole;
}

}  // namespace throng::imports
