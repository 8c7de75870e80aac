// Drawing what only the picture shows.
#pragma once

#include <epoxy/gl.h>

namespace throng::render {

/// While it lives, drawing changes colours but neither depth nor the other buffers.
class ColourOnly {
 public:
  ColourOnly() { allow(false); }
  ~ColourOnly() { allow(true); }
  ColourOnly(const ColourOnly&) = delete;
  ColourOnly& operator=(const ColourOnly&) = delete;

 private:
  static void allow(bool others) {
    constexpr GLuint kMostAttachments = 8;
    const GLboolean on = others ? GL_TRUE : GL_FALSE;
    glDepthMask(on);
    for (GLuint i = 1; i < kMostAttachments; ++i) glColorMaski(i, on, on, on, on);
  }
};

}  // namespace throng::render
