// Keypoints (COCO's 17) and joints (all) of the people in a frame, with their visibility.
#pragma once

#include <array>
#include <utility>

#include "annotate/people/frame_labels.h"
#include "render/frame/frame.h"

namespace throng::annotate {

/// COCO's skeleton: pairs of keypoints, as indices from 1.
inline constexpr std::array<std::pair<int, int>, 19> kSkeleton = {{{16, 14},
                                                                   {14, 12},
                                                                   {17, 15},
                                                                   {15, 13},
                                                                   {12, 13},
                                                                   {6, 12},
                                                                   {7, 13},
                                                                   {6, 7},
                                                                   {6, 8},
                                                                   {7, 9},
                                                                   {8, 10},
                                                                   {9, 11},
                                                                   {2, 3},
                                                                   {1, 2},
                                                                   {1, 3},
                                                                   {2, 4},
                                                                   {3, 5},
                                                                   {4, 6},
                                                                   {5, 7}}};

/// Sets the keypoints of all people in `labels`, which must be the labels of `frame`. A keypoint is
/// visible if, within a pixel of its projection, the image shows the person's surface in front of
/// the joint by no more than the joint's depth inside the body.
void add_keypoints(const render::Frame& frame, FrameLabels& labels);

/// Sets all joints by the same rule. A joint that is not visible is self_hidden if the image shows
/// the person at its projection.
void add_joints(const render::Frame& frame, FrameLabels& labels);

}  // namespace throng::annotate
