// Render target of the opacity of fire, smoke and gas in front of what the color pass's depth
// buffer shows.
#pragma once

#include <cstdint>
#include <vector>

#include "render/gl/gl_objects.h"

namespace throng::render {

class OpacityTarget {
 public:
  /// `depth` is the image's depth texture, of this size. Throws EnvironmentError when the device
  /// cannot make the buffers.
  OpacityTarget(int width, int height, GLuint depth);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds it for drawing, empty. Depth is tested, not written.
  void begin() const;

  /// As Frame::hazard_opacity.
  void read(std::vector<std::uint8_t>& opacity) const;

 private:
  int width_;
  int height_;
  Texture opacity_;
  Framebuffer framebuffer_;
};

}  // namespace throng::render
