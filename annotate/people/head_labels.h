// The box of each person's head, and how much of what it holds of them is visible.
#pragma once

#include "annotate/people/labels.h"
#include "render/frame.h"

namespace throng::annotate {

/// Sets the heads of everybody in `labels`, which are the frame's. It must have whole masks
/// (render::RenderOptions).
void add_heads(const render::Frame& frame, FrameLabels& labels);

}  // namespace throng::annotate
