// The occlusion mask of optical flow: visibility of a frame's surface points in the next frame.
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame/frame.h"

namespace throng::render {

/// Computes Frame::flow_target of `now`, which has flow and flow_depth_m, from the depth of `next`,
/// the next frame of its camera. A point is hidden if all pixels whose centers are less than 63/64
/// px away in x and in y are nearer to the camera by more than 5 cm and 0.2 % of the distance.
/// Supports any lens and shutter.
std::vector<std::uint8_t> flow_targets(const Frame& now, const Frame& next);

/// The Frame::flow_target of a frame without a next one.
std::vector<std::uint8_t> unknown_flow_targets(const Frame& now);

}  // namespace throng::render
