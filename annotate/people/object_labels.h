// Labels of the visible drones and vehicles in one frame, from its id buffer: boxes, masks,
// visibility.
#pragma once

#include <vector>

#include "annotate/people/frame_labels.h"
#include "render/frame/frame.h"

namespace throng::annotate {

/// One label for each object with a visible pixel, sorted by id.
std::vector<ObjectLabel> label_objects(const render::Frame& frame);

}  // namespace throng::annotate
