// Ground truth of the drones and vehicles that a camera sees: boxes, areas, whole masks and flow.
#pragma once

#include <span>

#include "render/frame.h"
#include "render/people/person_geometry.h"
#include "render/props/vehicles.h"
#include "render/scene.h"

namespace throng::render {

/// Sets Frame::objects from what the frame, which holds these rows, shows. Whole masks are the
/// projected triangles, filled where they hold a pixel's middle, and what is visible: the
/// rasterizer rounds corners to 1/256 of a pixel.
void measure_objects(const Scene& scene, std::span<const Vehicle> vehicles, const Rows& rows,
                     Frame& frame);

/// Fills flow where the ids show drones, which move as a whole. The frame is a pinhole's; `flow` is
/// as Frame::flow, `depth_m` (may be null) as Frame::flow_depth_m.
void fill_drone_flow(const Scene& scene, const NeighborFrame& other, const Frame& frame,
                     std::vector<float>& flow, std::vector<float>* depth_m);

}  // namespace throng::render
