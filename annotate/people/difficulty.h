// How hard people are to see in a frame, and what is in front of them.
#pragma once

#include "annotate/people/labels.h"
#include "render/frame.h"

namespace throng::annotate {

/// Sets the difficulty of everybody in `labels`, which are the frame's.
void add_difficulty(const render::Frame& frame, FrameLabels& labels);

/// Sets the occluders of everybody in `labels`: what the frame shows within their whole masks,
/// which it must have (render::RenderOptions).
void add_occluders(const render::Frame& frame, FrameLabels& labels);

}  // namespace throng::annotate
