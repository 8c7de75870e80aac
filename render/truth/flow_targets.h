// Whether what a frame shows is seen in the next frame of its camera: the occlusion mask of flow.
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame.h"

namespace throng::render {

/// Frame::flow_target of `now`, which has flow and flow_depth_m, from the depth of `next`, the next
/// frame of its camera. A point is hidden if all pixels whose middles are less than 63/64 px away
/// from it in x and in y show what is nearer to the camera, by more than 5 cm and 0.2 % of its
/// distance. Any lens and shutter.
std::vector<std::uint8_t> flow_targets(const Frame& now, const Frame& next);

/// That of a frame without a next one.
std::vector<std::uint8_t> unknown_flow_targets(const Frame& now);

}  // namespace throng::render
