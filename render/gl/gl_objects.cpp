#include "render/gl/gl_objects.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "base/error.h"

namespace throng::render {

namespace {

std::string info_log(GLuint shader, bool program) {
  std::array<char, 4096> text{};
  GLsizei length = 0;
  if (program) {
    glGetProgramInfoLog(shader, static_cast<GLsizei>(text.size()), &length, text.data());
  } else {
    glGetShaderInfoLog(shader, static_cast<GLsizei>(text.size()), &length, text.data());
  }
  return {text.data(), static_cast<std::size_t>(length)};
}

void attach_stage(GLuint program, GLenum stage, std::initializer_list<std::string_view> pieces) {
  if (pieces.size() == 0) return;
  std::vector<const char*> texts = {"#version 450 core\n"};
  std::vector<GLint> lengths = {-1};
  for (const std::string_view piece : pieces) {
    texts.push_back(piece.data());
    lengths.push_back(static_cast<GLint>(piece.size()));
  }
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  const std::string log = compiled == 0 ? info_log(shader, false) : std::string();
  glAttachShader(program, shader);
  glDeleteShader(shader);  // lives as long as the program
  if (compiled == 0) throw EnvironmentError("the GL driver rejects a shader:\n" + log);
}

}  // namespace

Buffer make_buffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return Buffer(name);
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}

Texture make_texture(GLenum target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return Texture(name);
}

Sampler make_sampler() {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  return Sampler(name);
}

Texture make_texture_2d(GLenum format, int width, int height) {
  Texture texture = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, format, width, height);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

Framebuffer make_framebuffer(std::initializer_list<GLuint> colors, GLuint depth) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer framebuffer(name);
  std::vector<GLenum> attachments;
  for (const GLuint color : colors) {
    attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
    glNamedFramebufferTexture(name, attachments.back(), color, 0);
  }
  if (depth != 0) glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth, 0);
  glNamedFramebufferDrawBuffers(name, static_cast<GLsizei>(attachments.size()), attachments.data());
  const GLenum status = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw EnvironmentError(
        fmt::format("the GL driver cannot render into these buffers (status {:#06x})", status));
  }
  return framebuffer;
}

Program make_program(std::initializer_list<std::string_view> vertex,
                     std::initializer_list<std::string_view> fragment) {
  Program program(glCreateProgram());
  attach_stage(program.name(), GL_VERTEX_SHADER, vertex);
  attach_stage(program.name(), GL_FRAGMENT_SHADER, fragment);
  glLinkProgram(program.name());
  GLint linked = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == 0) {
    throw EnvironmentError("the GL driver cannot link a program:\n" +
                           info_log(program.name(), true));
  }
  return program;
}

void check_gl(std::string_view what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  throw EnvironmentError(
      error == GL_OUT_OF_MEMORY
          ? fmt::format("the GL device ran out of memory while {}", what)
          : fmt::format("the GL driver reports error {:#06x} while {}", error, what));
}

void describe_vertices(const VertexArray& array, GLuint binding, const Buffer& buffer,
                       std::size_t stride, GLuint divisor,
                       std::initializer_list<Attribute> attributes) {
  const GLuint name = array.name();
  glVertexArrayVertexBuffer(name, binding, buffer.name(), 0, static_cast<GLsizei>(stride));
  glVertexArrayBindingDivisor(name, binding, divisor);
  for (const Attribute& a : attributes) {
    const auto offset = static_cast<GLuint>(a.offset);
    if (a.type == GL_FLOAT || a.normalized) {
      glVertexArrayAttribFormat(name, a.location, a.count, a.type,
                                a.normalized ? GL_TRUE : GL_FALSE, offset);
    } else {
      glVertexArrayAttribIFormat(name, a.location, a.count, a.type, offset);
    }
    glVertexArrayAttribBinding(name, a.location, binding);
    glEnableVertexArrayAttrib(name, a.location);
  }
}

}  // namespace throng::render
