// Labels of the drones that a frame shows, from its id buffer: boxes, masks, visibility.
#pragma once

#include <vector>

#include "annotate/labels.h"
#include "render/frame.h"

namespace throng::annotate {

/// Of each drone with a visible pixel, by number.
std::vector<DroneLabel> label_drones(const render::Frame& frame);

}  // namespace throng::annotate
