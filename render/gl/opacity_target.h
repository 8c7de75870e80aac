// Render target for the opacity of fire, smoke and gas in front of the color pass's depth buffer.
#pragma once

#include <cstdint>
#include <vector>

#include "render/gl/gl_objects.h"

namespace throng::render {

class OpacityTarget {
 public:
  /// `depth` is the image's depth texture, of the same size. Throws EnvironmentError if the device
  /// cannot create the buffers.
  OpacityTarget(int width, int height, GLuint depth);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds the target for drawing and clears it. Depth is tested, but not written.
  void begin() const;

  /// Reads the values in the form of Frame::hazard_opacity.
  void read(std::vector<std::uint8_t>& opacity) const;

 private:
  int width_;
  int height_;
  Texture opacity_;
  Framebuffer framebuffer_;
};

}  // namespace throng::render
