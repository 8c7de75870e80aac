// The members of a person's COCO record that no COCO reader needs, but many a user: pose, place and
// facts (docs/formats.md).
#pragma once

#include <string>

#include "annotate/people/coco.h"
#include "annotate/people/labels.h"

namespace throng::annotate {

/// Share of a box that is outside of the image.
double measure_truncation(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k);

/// A box with its corner and size rounded as records have them.
Eigen::AlignedBox2d recorded_box(const Eigen::AlignedBox2d& box);

/// The truncation in a record: that of the recorded box, rounded; 0: not truncated.
double recorded_truncation(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k);

/// How something lies in the image and in the world.
struct Placed {
  Eigen::AlignedBox2d amodal_box;
  double yaw_rad = 0;
  Eigen::Vector3d box_middle;
  Eigen::Vector3d box_size;
};

/// Appends truncation, heading and upright box, each after a comma.
void append_pose_members(std::string& text, const CocoImage& image, const Placed& placed);

/// Appends the members, each after a comma.
void append_person_members(std::string& text, const CocoImage& image, const PersonLabel& label);

}  // namespace throng::annotate
