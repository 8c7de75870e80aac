// Ground truth of drones and vehicles in view: boxes, areas, amodal masks and flow.
#pragma once

#include <span>

#include "render/frame/frame.h"
#include "render/people/person_geometry.h"
#include "render/props/scene.h"
#include "render/props/vehicles.h"

namespace throng::render {

/// Sets Frame::objects of a frame with these rows: those that reach into the image or, unless these
/// are all rows, into the measured pixels beside the rows. Amodal masks are the pixels whose
/// centers are in projected triangles, united with the visible pixels, since the rasterizer rounds
/// corners to 1/256 of a pixel.
void measure_objects(const Scene& scene, std::span<const Vehicle> vehicles, const Rows& rows,
                     Frame& frame);

/// Fills flow where the ids show drones, which are rigid. The frame's camera must be a pinhole;
/// `flow` is as Frame::flow, `depth_m` (may be null) as Frame::flow_depth_m.
void fill_drone_flow(const Scene& scene, const NeighborFrame& other, const Frame& frame,
                     std::vector<float>& flow, std::vector<float>* depth_m);

}  // namespace throng::render
