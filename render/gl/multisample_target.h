// Colors with several samples a pixel, for devices on which that is nearly free. Ids, depth and
// everything else that is exact comes from a draw of its own, one sample a pixel (target.h).
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame.h"
#include "render/gl/gl_objects.h"

namespace throng::render {

class MultisampleTarget {
 public:
  /// Throws EnvironmentError when the device has no such buffers.
  MultisampleTarget(int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds it for drawing, black and with infinite depth.
  void begin() const;

  /// Fills the frame's rgb: the mean of each pixel's light.
  void read(Frame& frame);

 private:
  int width_;
  int height_;
  Texture color_;
  Texture depth_;
  Framebuffer framebuffer_;
  Texture resolved_color_;
  Framebuffer resolved_;
  std::vector<std::uint32_t> rgba_;  ///< as read, kept between frames
};

}  // namespace throng::render
