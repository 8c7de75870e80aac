#include "render/gl/surface_target.h"

#include <array>
#include <limits>

#include "render/frame/view.h"

namespace throng::render {

SurfaceTarget::SurfaceTarget(int width, int height, GLuint depth, bool with_flow_depth)
    : width_(width),
      height_(height),
      normal_(make_texture_2d(GL_RGBA8, width, height)),
      flow_(make_texture_2d(with_flow_depth ? GL_RGBA32F : GL_RG32F, width, height)),
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
  const std::array<float, 4> no_flow = {kUnknownFlow, kUnknownFlow, kUnknownFlow, 0};
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

std::size_t SurfaceTarget::pixels() const {
  return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

void SurfaceTarget::select(GLenum attachment) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(attachment);
}

void SurfaceTarget::read_normals(std::vector<std::uint8_t>& normals) const {
  normals.resize(pixels() * 3);
  select(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, normals.data());
}

void SurfaceTarget::read_flow(std::vector<float>& flow, std::vector<float>* depth_m) const {
  flow.resize(pixels() * 2);
  select(GL_COLOR_ATTACHMENT1);
  glReadPixels(0, 0, width_, height_, GL_RG, GL_FLOAT, flow.data());
  if (depth_m == nullptr) return;
  depth_m->resize(pixels());
  glReadPixels(0, 0, width_, height_, GL_BLUE, GL_FLOAT, depth_m->data());
}

void SurfaceTarget::read_parts(std::vector<std::uint8_t>& parts) const {
  parts.resize(pixels());
  select(GL_COLOR_ATTACHMENT2);
  glReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_BYTE, parts.data());
}

}  // namespace throng::render
