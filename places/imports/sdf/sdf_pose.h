// Poses of SDF elements as transforms of Eigen.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace sdf {
inline namespace v12 {
class SemanticPose;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// The pose of an element in the frame `relative_to`; "": that of the element that contains it.
/// Nothing if a frame is unknown or a number is not finite.
std::optional<Eigen::Isometry3d> resolved_pose(const sdf::SemanticPose& pose,
                                               const std::string& relative_to = "");

}  // namespace throng::imports
