// Boxes of people's heads and their visibility.
#pragma once

#include "annotate/people/labels.h"
#include "render/frame/frame.h"

namespace throng::annotate {

/// Sets the heads of all people in `labels`, which must be the labels of `frame`. The frame must
/// have amodal masks (render::RenderOptions).
void add_heads(const render::Frame& frame, FrameLabels& labels);

}  // namespace throng::annotate
