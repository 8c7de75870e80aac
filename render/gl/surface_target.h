// Render target of people's normals, flow and body parts, where the color pass's depth buffer shows
// them.
#pragma once

#include <vector>

#include "render/frame.h"
#include "render/gl/gl_objects.h"

namespace throng::render {

class SurfaceTarget {
 public:
  /// `depth` is the image's depth texture, of this size. Throws EnvironmentError when the device
  /// cannot make the buffers.
  SurfaceTarget(int width, int height, GLuint depth);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds it for drawing, empty; only what has exactly the depth that is there is rendered.
  void begin() const;
  /// Ends that mode of depth testing.
  void end() const;

  /// Fills the frame's normal, flow and part for people; elsewhere they are 0, NaN and none.
  void read(bool normals, bool flow, bool parts, Frame& frame) const;

 private:
  int width_;
  int height_;
  Texture normal_;
  Texture flow_;
  Texture part_;
  Framebuffer framebuffer_;
};

}  // namespace throng::render
