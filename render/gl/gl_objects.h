// Owners of OpenGL objects. The context that created an object must be current at its destruction.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace throng::render {

/// The name of a GL object and the function that deletes it.
template <void (*Delete)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (name_ != 0) Delete(name_);
  }
  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

inline void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void delete_sampler(GLuint name) { glDeleteSamplers(1, &name); }
inline void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void delete_program(GLuint name) { glDeleteProgram(name); }

using Buffer = Handle<delete_buffer>;
using Texture = Handle<delete_texture>;
using Sampler = Handle<delete_sampler>;
using Framebuffer = Handle<delete_framebuffer>;
using VertexArray = Handle<delete_vertex_array>;
using Program = Handle<delete_program>;

/// An empty buffer, to be filled with glNamedBufferData.
Buffer make_buffer();

/// A buffer with this immutable content.
template <typename T>
Buffer make_buffer(std::span<const T> content) {
  Buffer buffer = make_buffer();
  // GL refuses empty storage.
  const std::size_t bytes = content.empty() ? sizeof(T) : content.size_bytes();
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(bytes),
                       content.empty() ? nullptr : content.data(), 0);
  return buffer;
}
template <typename T>
Buffer make_buffer(const std::vector<T>& content) {
  return make_buffer(std::span<const T>(content));
}

VertexArray make_vertex_array();

/// A texture of `target` with default sampling.
Texture make_texture(GLenum target);

/// A sampler object, which overrides a texture's settings.
Sampler make_sampler();

/// A single-level 2D texture, sampled to the nearest texel, clamped to its edge.
Texture make_texture_2d(GLenum format, int width, int height);

/// A framebuffer with these color textures (in order) and depth texture (0: none). Throws
/// EnvironmentError if the driver cannot draw into it.
Framebuffer make_framebuffer(std::initializer_list<GLuint> colors, GLuint depth);

/// Compiles a program. Each stage is "#version 450 core" followed by its pieces. Without fragment
/// pieces the program only writes depth. Throws EnvironmentError with the driver's log.
Program make_program(std::initializer_list<std::string_view> vertex,
                     std::initializer_list<std::string_view> fragment);

/// Throws EnvironmentError if GL has recorded an error; `what` names the operation in the message.
void check_gl(std::string_view what);

/// The storage of one attribute in a vertex; integers stay integers unless normalized.
struct Attribute {
  GLuint location;
  GLint count;
  GLenum type;
  bool normalized;
  std::size_t offset;
};

/// Describes the vertices of `buffer` at binding point `binding`. `divisor` 1: one per instance.
void describe_vertices(const VertexArray& array, GLuint binding, const Buffer& buffer,
                       std::size_t stride, GLuint divisor,
                       std::initializer_list<Attribute> attributes);

}  // namespace throng::render
