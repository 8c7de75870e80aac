// Difficulty of the people in a frame, and the objects that occlude them.
#pragma once

#include "annotate/people/contrast.h"
#include "annotate/people/labels.h"
#include "render/frame/frame.h"

namespace throng::annotate {

/// Sets the difficulty of all people in `labels`, which must be the labels of `frame`. `image` has
/// the frame's pixels as they are delivered, i.e. after compression; contrasts and lookalikes are
/// its.
void add_difficulty(const render::Frame& frame, const ColorImage& image, FrameLabels& labels);

/// Sets the occluders of all people in `labels`: the instances that the frame shows within their
/// amodal masks. The frame must have these masks (render::RenderOptions).
void add_occluders(const render::Frame& frame, FrameLabels& labels);

}  // namespace throng::annotate
