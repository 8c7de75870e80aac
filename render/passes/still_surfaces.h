// Normals and flow of whatever stands still, from the depth buffer: exact for flow, and for the
// normals of planes that are a few pixels wide.
#pragma once

#include "camera/camera.h"
#include "render/frame.h"

namespace throng::render {

/// Fills Frame::normal where the ids show no person.
void fill_still_normals(Frame& frame);

/// Fills Frame::flow where the ids show no person: how pixels move when the frame's camera becomes
/// `next`.
void fill_still_flow(const camera::Camera& next, Frame& frame);

}  // namespace throng::render
