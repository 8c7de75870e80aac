// Render target of the camera: color, instance id and depth, and their transfer to a Frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/frame/frame.h"
#include "render/gl/gl_objects.h"

namespace throng::render {

/// Max width and height of a target on the current context's device.
int max_target_px();

class Target {
 public:
  /// Throws EnvironmentError if the device cannot create buffers of this size.
  Target(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds the target for drawing and clears it to the color `sky`, id kIdNothing and infinite
  /// depth.
  void begin(const Eigen::Vector3f& sky) const;

  /// Fills the frame's id and depth_m, and its rgb if `color`.
  void read(bool color, Frame& frame);

  /// Fills only the frame's rgb, which is smaller by the factor `samples` along each side: each
  /// pixel is the mean of its samples in linear light.
  void read_light(int samples, Frame& frame);

  /// Keeps the depth as it is now, and brings it back: for draws that need depth of their own but
  /// are no part of the ground truth.
  void keep_depth();
  void restore_depth() const;

  GLuint depth_texture() const { return depth_.name(); }

 private:
  int width_;
  int height_;
  Texture color_;
  Texture id_;
  Texture depth_;
  std::optional<Texture> kept_depth_;
  Framebuffer framebuffer_;
  std::vector<std::uint32_t> rgba_;  ///< buffer for reading, kept between frames
};

/// Converts RGBA to RGB by removing the fourth byte of each pixel.
void pack_rgb(const std::vector<std::uint32_t>& rgba, std::vector<std::uint8_t>& rgb);

}  // namespace throng::render
