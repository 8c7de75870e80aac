// Ground truth of the drones that a camera sees: boxes, areas, whole masks and flow.
#pragma once

#include "render/frame.h"
#include "render/people/person_geometry.h"
#include "render/scene.h"

namespace throng::render {

/// Sets Frame::drones from what the frame, which holds these rows, shows. Whole masks are the
/// projected triangles, filled where they hold a pixel's middle, and what is visible: the
/// rasterizer rounds corners to 1/256 of a pixel.
void measure_drones(const Scene& scene, const Rows& rows, Frame& frame);

/// Fills Frame::flow where the ids show drones, which move as a whole. The frame is a pinhole's.
void fill_drone_flow(const Scene& scene, const NextFrame& next, Frame& frame);

}  // namespace throng::render
