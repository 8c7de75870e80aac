// Normals and flow of whatever stands still, from the depth buffer: exact for flow, and for the
// normals of planes that are a few pixels wide.
#pragma once

#include <vector>

#include "camera/camera.h"
#include "render/frame.h"

namespace throng::render {

/// Fills Frame::normal where the ids show no person.
void fill_still_normals(Frame& frame);

/// Fills flow where the ids show no person: how pixels move when the frame's camera becomes
/// `other`. `flow` is as Frame::flow, `depth_m` (may be null) as Frame::flow_depth_m.
void fill_still_flow(const camera::Camera& other, const Frame& frame, std::vector<float>& flow,
                     std::vector<float>* depth_m);

/// Frame::scene_flow_m from a frame's depth, flow and flow_depth_m, of a pinhole camera that
/// becomes `next`.
std::vector<float> compute_scene_flow(const Frame& frame, const camera::Camera& next);

}  // namespace throng::render
