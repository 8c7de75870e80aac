#include "render/gl/multisample_target.h"

#include <array>

#include "render/frame/view.h"
#include "render/gl/target.h"

namespace throng::render {

namespace {

Texture make_multisample_texture(GLenum format, int width, int height, int samples) {
  Texture texture = make_texture(GL_TEXTURE_2D_MULTISAMPLE);
  glTextureStorage2DMultisample(texture.name(), samples, format, width, height, GL_TRUE);
  check_gl("making buffers with several samples a pixel");
  return texture;
}

}  // namespace

// Shaders write sRGB values as they are. That the buffer is known to hold such matters when its
// samples are averaged: as light.
MultisampleTarget::MultisampleTarget(int width, int height, int samples)
    : width_(width),
      height_(height),
      color_(make_multisample_texture(GL_SRGB8_ALPHA8, width, height, samples)),
      depth_(make_multisample_texture(GL_DEPTH_COMPONENT32F, width, height, samples)),
      framebuffer_(make_framebuffer({color_.name()}, depth_.name())),
      resolved_color_(make_texture_2d(GL_SRGB8_ALPHA8, width, height)),
      resolved_(make_framebuffer({resolved_color_.name()}, 0)) {}

void MultisampleTarget::begin() const {
  const GLuint name = framebuffer_.name();
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  const Viewport viewport = guarded_viewport(width_, height_);
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  const std::array<float, 4> black = {0, 0, 0, 1};
  const float infinitely_far = 0.0F;
  glClearNamedFramebufferfv(name, GL_COLOR, 0, black.data());
  glClearNamedFramebufferfv(name, GL_DEPTH, 0, &infinitely_far);
}

void MultisampleTarget::read(Frame& frame) {
  glEnable(GL_FRAMEBUFFER_SRGB);
  glBlitNamedFramebuffer(framebuffer_.name(), resolved_.name(), 0, 0, width_, height_, 0, 0, width_,
                         height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  rgba_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  pack_rgb(rgba_, frame.rgb);
}

}  // namespace throng::render
