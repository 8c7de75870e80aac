#include "render/gl/shadow_map.h"

#include <algorithm>
#include <array>

namespace throng::render {

ShadowMap::ShadowMap(int texels)
    : texels_(std::max(texels, 1)),
      depth_(make_texture_2d(GL_DEPTH_COMPONENT32F, texels_, texels_)),
      heights_(make_sampler()),
      framebuffer_(make_framebuffer({}, depth_.name())) {
  const GLuint name = depth_.name();
  // Outside the map nothing is higher than the ground: lit.
  const std::array<float, 4> ground{};
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  glTextureParameterfv(name, GL_TEXTURE_BORDER_COLOR, ground.data());
  glTextureParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  glSamplerParameteri(heights_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glSamplerParameteri(heights_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glSamplerParameteri(heights_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glSamplerParameteri(heights_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  glSamplerParameterfv(heights_.name(), GL_TEXTURE_BORDER_COLOR, ground.data());
  begin();
}

void ShadowMap::begin() const {
  const float ground = 0.0F;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, texels_, texels_);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &ground);
}

void ShadowMap::bind() const {
  glBindTextureUnit(1, depth_.name());
  glBindTextureUnit(4, depth_.name());
  glBindSampler(4, heights_.name());
}

}  // namespace throng::render
