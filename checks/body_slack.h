// How far boxes of whole bodies may be from other labels of the same people.
#pragma once

#include <algorithm>

#include "camera/camera.h"
#include "formats/dataset/dataset.h"
#include "formats/dataset/image_camera.h"

namespace throng::checks {

/// Boxes and areas of whole bodies come from another draw than masks: outlines may be off by less
/// than a pixel.
inline constexpr double kBoxSlackPx = 1;

/// Whether a box, widened on all sides, contains a point.
inline bool holds(const formats::Box& outer, double x, double y, double slack) {
  return x >= outer.x - slack && y >= outer.y - slack && x <= outer.x + outer.width + slack &&
         y <= outer.y + outer.height + slack;
}

/// Joints of the skeleton may lie outside of the meshes of small people, which end within a pixel
/// of the finest (skinning::extent_slack_m()) but have few triangles around thin limbs. More is
/// permitted: older datasets have meshes of 64 triangles without forearms.
inline double keypoint_slack_px(const camera::Camera& camera, const formats::Person& person) {
  constexpr double kCoarseShare = 0.1;
  constexpr double kSmallPx = 120;
  constexpr double kForearmM = 0.5;
  const double size_px = std::max(person.amodal.width, person.amodal.height);
  const double limb_px =
      size_px < kSmallPx ? formats::pixels_across(camera, person.box_middle, kForearmM) : 0;
  return kBoxSlackPx + std::max(kCoarseShare * size_px, limb_px);
}

}  // namespace throng::checks
