// Render target of people's normals, flow and body parts, where the color pass's depth buffer shows
// them.
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame.h"
#include "render/gl/gl_objects.h"

namespace throng::render {

class SurfaceTarget {
 public:
  /// `depth` is the image's depth texture, of this size. Throws EnvironmentError when the device
  /// cannot make the buffers.
  SurfaceTarget(int width, int height, GLuint depth, bool with_flow_depth);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds it for drawing, empty; only what has exactly the depth that is there is rendered.
  void begin() const;
  /// Ends that mode of depth testing.
  void end() const;

  // Values as in Frame, of people; elsewhere normals are 0, flow is NaN and parts are none.
  void read_normals(std::vector<std::uint8_t>& normals) const;
  void read_parts(std::vector<std::uint8_t>& parts) const;
  /// `depth_m` may be null; otherwise the target must have been made with flow's depth.
  void read_flow(std::vector<float>& flow, std::vector<float>* depth_m) const;

 private:
  std::size_t pixels() const;
  void select(GLenum attachment) const;

  int width_;
  int height_;
  Texture normal_;
  Texture flow_;
  Texture part_;
  Framebuffer framebuffer_;
};

}  // namespace throng::render
