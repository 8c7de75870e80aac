#include "render/gl/surface_target.h"

#include <array>
#include <limits>

#include "render/view.h"

namespace throng::render {

SurfaceTarget::SurfaceTarget(int width, int height, GLuint depth)
    : width_(width),
      height_(height),
      normal_(make_texture_2d(GL_RGBA8, width, height)),
      flow_(make_texture_2d(GL_RG32F, width, height)),
      part_(make_texture_2d(GL_R8UI, width, height)) {
  check_gl("making the buffers of surfaces");
  framebuffer_ = make_framebuffer({normal_.name(), flow_.name(), part_.name()}, depth);
}

void SurfaceTarget::begin() const {
  const GLuint name = framebuffer_.name();
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  const Viewport viewport = guarded_viewport(width_, height_);
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  constexpr float kUnknownFlow = std::numeric_limits<float>::quiet_NaN();
  const std::array<float, 4> no_normal{};
  const std::array<float, 4> no_flow = {kUnknownFlow, kUnknownFlow, 0, 0};
  const std::array<GLuint, 4> no_part{};
  glClearNamedFramebufferfv(name, GL_COLOR, 0, no_normal.data());
  glClearNamedFramebufferfv(name, GL_COLOR, 1, no_flow.data());
  glClearNamedFramebufferuiv(name, GL_COLOR, 2, no_part.data());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
}

void SurfaceTarget::end() const {
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
}

void SurfaceTarget::read(bool normals, bool flow, bool parts, Frame& frame) const {
  const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  if (normals) {
    frame.normal.resize(pixels * 3);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, frame.normal.data());
  }
  if (flow) {
    frame.flow.resize(pixels * 2);
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, width_, height_, GL_RG, GL_FLOAT, frame.flow.data());
  }
  if (parts) {
    frame.part.resize(pixels);
    glReadBuffer(GL_COLOR_ATTACHMENT2);
    glReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_BYTE, frame.part.data());
  }
}

}  // namespace throng::render
