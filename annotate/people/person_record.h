// Members of a person's record beyond the COCO format: pose, position and attributes
// (docs/formats.md).
#pragma once

#include <string>

#include "annotate/people/coco_image.h"
#include "annotate/people/frame_labels.h"

namespace throng::annotate {

/// The share of a box's area that is outside of the image, 0 to 1.
double measure_truncation(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k);

/// A box with corner and size rounded as in records.
Eigen::AlignedBox2d recorded_box(const Eigen::AlignedBox2d& box);

/// The value `truncation` of a record: measure_truncation() of the recorded box, rounded.
double recorded_truncation(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k);

/// Pose of a person or object in the image and in the world.
struct Placed {
  Eigen::AlignedBox2d amodal_box;  ///< box coordinates, px
  double yaw_rad = 0;              ///< heading in the world
  Eigen::Vector3d box_middle;      ///< center of the upright 3-D box, m
  Eigen::Vector3d box_size;        ///< m
};

/// Appends truncation, heading and upright 3-D box as JSON members, each after a comma.
void append_pose_members(std::string& text, const CocoImage& image, const Placed& placed);

/// Appends all members of a person as JSON, each after a comma.
void append_person_members(std::string& text, const CocoImage& image, const PersonLabel& label);

}  // namespace throng::annotate
