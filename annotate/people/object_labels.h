// Labels of the drones and vehicles that a frame shows, from its id buffer: boxes, masks,
// visibility.
#pragma once

#include <vector>

#include "annotate/people/labels.h"
#include "render/frame.h"

namespace throng::annotate {

/// A label for each object with a visible pixel, by id.
std::vector<ObjectLabel> label_objects(const render::Frame& frame);

}  // namespace throng::annotate
