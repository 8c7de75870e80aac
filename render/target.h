// What the camera's draw writes: colour, instance id and depth, and how they come back.
#pragma once

#include "render/frame.h"
#include "render/gl_objects.h"

namespace throng::render {

class Target {
 public:
  /// Throws EnvironmentError when the device cannot make buffers of this size.
  Target(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds it for drawing, with colour = `sky`, ids kIdNothing and depth infinite.
  void begin(const Eigen::Vector3f& sky) const;

  /// Fills the frame's rgb, id and depth_m.
  void read(Frame& frame) const;

 private:
  int width_;
  int height_;
  Texture colour_;
  Texture id_;
  Texture depth_;
  Framebuffer framebuffer_;
};

}  // namespace throng::render
