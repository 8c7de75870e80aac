// Render target of the camera: color, instance id and depth, and how they come back.
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame.h"
#include "render/gl/gl_objects.h"

namespace throng::render {

/// The largest width and height of a target on the current context's device.
int max_target_px();

class Target {
 public:
  /// Throws EnvironmentError when the device cannot make buffers of this size.
  Target(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds it for drawing, with color = `sky`, ids kIdNothing and depth infinite.
  void begin(const Eigen::Vector3f& sky) const;

  /// Fills the frame's id and depth_m, and its rgb if `color` is wanted.
  void read(bool color, Frame& frame);

  /// Fills the frame's rgb alone, which is smaller by `samples` along each side: each pixel is the
  /// mean of its light.
  void read_light(int samples, Frame& frame);

  GLuint depth_texture() const { return depth_.name(); }

 private:
  int width_;
  int height_;
  Texture color_;
  Texture id_;
  Texture depth_;
  Framebuffer framebuffer_;
  std::vector<std::uint32_t> rgba_;  ///< as read, kept between frames
};

/// Drops the fourth byte of each pixel.
void pack_rgb(const std::vector<std::uint32_t>& rgba, std::vector<std::uint8_t>& rgb);

}  // namespace throng::render
