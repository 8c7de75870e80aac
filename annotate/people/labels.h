// Labels of the visible people in one frame, from its id buffer: boxes, masks, visibility.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "annotate/people/frame_labels.h"
#include "render/frame/frame.h"

namespace throng::annotate {

/// Labels a frame in one pass over its id buffer. Fails a check() if an agent in the buffer is not
/// in Frame::people.
FrameLabels label_people(const render::Frame& frame);

}  // namespace throng::annotate
