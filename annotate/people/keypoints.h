// Joints of the people in a frame, COCO's 17 keypoints or all of them, with what the image shows of
// them.
#pragma once

#include <array>
#include <utility>

#include "annotate/people/labels.h"
#include "render/frame.h"

namespace throng::annotate {

/// COCO's bones between the keypoints, as numbers from 1.
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

/// Sets the keypoints of everybody in `labels`, which are the frame's. A keypoint is visible if,
/// within a pixel of its place, the image shows the person at its depth: as deep inside the body
/// as the joint lies, and no deeper.
void add_keypoints(const render::Frame& frame, FrameLabels& labels);

/// Sets all joints in the same way. One that is not visible is hidden by the own body if the image
/// shows the person at its place.
void add_joints(const render::Frame& frame, FrameLabels& labels);

}  // namespace throng::annotate
