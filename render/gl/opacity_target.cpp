#include "render/gl/opacity_target.h"

#include <array>

#include "render/frame/view.h"

namespace throng::render {

OpacityTarget::OpacityTarget(int width, int height, GLuint depth)
    : width_(width), height_(height), opacity_(make_texture_2d(GL_RGBA8, width, height)) {
  check_gl("making the buffer of opacity");
  framebuffer_ = make_framebuffer({opacity_.name()}, depth);
}

void OpacityTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  const Viewport viewport = guarded_viewport(width_, height_);
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  const std::array<float, 4> clear{};
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, clear.data());
  glEnable(GL_DEPTH_TEST);
}

void OpacityTarget::read(std::vector<std::uint8_t>& opacity) const {
  opacity.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, opacity.data());
}

}  // namespace throng::render
