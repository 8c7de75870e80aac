// Normals and flow of static surfaces from the depth buffer. Flow is exact; normals are exact for
// planes that are a few pixels wide.
#pragma once

#include <vector>

#include "camera/camera.h"
#include "render/frame/frame.h"

namespace throng::render {

/// Fills Frame::normal where the ids show no person.
void fill_still_normals(Frame& frame);

/// Fills flow where the ids show no person: the motion of pixels from the frame's camera to
/// `other`. `flow` is as Frame::flow, `depth_m` (may be null) as Frame::flow_depth_m.
void fill_still_flow(const camera::Camera& other, const Frame& frame, std::vector<float>& flow,
                     std::vector<float>* depth_m);

/// Computes Frame::scene_flow_m from depth, flow and flow_depth_m of a frame of a pinhole camera;
/// `next` is the camera of the next frame.
std::vector<float> compute_scene_flow(const Frame& frame, const camera::Camera& next);

}  // namespace throng::render
