// Joints in a person's record, for skeleton formats.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

#include "skinning/landmarks.h"

namespace throng::formats {

struct JointInImage {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< box coordinates; 0 outside of the image
  int state = 0;                                    ///< annotate::JointLabel::State

  bool is_inside() const { return state != 0; }
  bool is_visible() const { return state == 2; }
  bool is_self_hidden() const { return state == 3; }
  /// COCO's value: 0 outside of the image, 1 hidden, 2 visible.
  int coco_visibility() const { return is_visible() ? 2 : is_inside() ? 1 : 0; }
};

/// The joints of a record, in the order of skinning::Joint. Throws InputError if joints are
/// missing.
std::vector<JointInImage> read_joints(const nlohmann::json& record);

/// The joints' positions in the world (m), in the same order. Throws InputError if joints are
/// missing.
std::vector<Eigen::Vector3d> read_joints_3d(const nlohmann::json& record);

}  // namespace throng::formats
