// Render target for normals, flow and body parts of people where they are visible in the color
// pass's depth buffer.
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame/frame.h"
#include "render/gl/gl_objects.h"

namespace throng::render {

class SurfaceTarget {
 public:
  /// `depth` is the image's depth texture, of the same size. Throws EnvironmentError if the device
  /// cannot create the buffers.
  SurfaceTarget(int width, int height, GLuint depth, bool with_flow_depth);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Binds the target for drawing and clears it. Only fragments with exactly the existing depth
  /// pass.
  void begin() const;
  /// Restores the depth test.
  void end() const;

  // Values of people as in Frame; elsewhere normals are 0, flow is NaN and parts are
  // BodyPart::none.
  void read_normals(std::vector<std::uint8_t>& normals) const;
  void read_parts(std::vector<std::uint8_t>& parts) const;
  /// `depth_m` may be null; otherwise the target must have been made with `with_flow_depth`.
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
