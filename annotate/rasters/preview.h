// Images for people: the frame with boxes, ids and counts drawn on it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "annotate/people/labels.h"
#include "render/frame.h"

namespace throng::annotate {

/// The frame's colors with each visible person's box (color by track id) and a caption line
/// (time, visible count). Returns RGB, same size.
std::vector<std::uint8_t> draw_preview(const render::Frame& frame, const FrameLabels& labels);

/// JPEG bytes of RGB rows (libjpeg-turbo). Quality 1..100; 4:2:0.
std::string jpeg_bytes(const std::vector<std::uint8_t>& rgb, int width, int height, int quality);

}  // namespace throng::annotate
