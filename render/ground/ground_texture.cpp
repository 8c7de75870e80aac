#include "render/ground/ground_texture.h"

#include <bit>

#include "render/gl/shaders.h"

namespace throng::render {

namespace {

// An image seen at a slant is sharper than the mipmaps allow for.
constexpr float kSharper = -0.4F;

}  // namespace

Texture bake_ground(std::string_view material_shader, int texels) {
  const Program program = make_program({embedded::shader_ground_bake_vert},
                                       {embedded::shader_noise, embedded::shader_ground_tile,
                                        material_shader, embedded::shader_ground_bake_frag});
  Texture texture = make_texture(GL_TEXTURE_2D);
  const GLuint name = texture.name();
  const int levels = std::bit_width(static_cast<unsigned>(texels));
  glTextureStorage2D(name, levels, GL_RGBA8, texels, texels);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTextureParameterf(name, GL_TEXTURE_LOD_BIAS, kSharper);
  const Framebuffer framebuffer = make_framebuffer({name}, 0);
  const VertexArray nothing = make_vertex_array();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewport(0, 0, texels, texels);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(nothing.name());
  glUseProgram(program.name());
  glUniform1f(glGetUniformLocation(program.name(), "texels"), static_cast<float>(texels));
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glGenerateTextureMipmap(name);
  check_gl("drawing a ground's texture");
  return texture;
}

}  // namespace throng::render
