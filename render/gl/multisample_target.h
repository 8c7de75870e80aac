// Render target for colors with several samples per pixel, for devices on which this is nearly
// free. Ids, depth and other exact buffers come from a separate draw with one sample per pixel
// (target.h).
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame/frame.h"
#include "render/gl/gl_objects.h"

namespace throng::render {

class MultisampleTarget {
 public:
  /// Throws EnvironmentError if the device has no such buffers.
  MultisampleTarget(int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds the target for drawing and clears it to black and infinite depth.
  void begin() const;

  /// Fills the frame's rgb with the mean of each pixel's samples in linear light.
  void read(Frame& frame);

 private:
  int width_;
  int height_;
  Texture color_;
  Texture depth_;
  Framebuffer framebuffer_;
  Texture resolved_color_;
  Framebuffer resolved_;
  std::vector<std::uint32_t> rgba_;  ///< buffer for reading, kept between frames
};

}  // namespace throng::render
