// Drawing into the color buffer only.
#pragma once

#include <epoxy/gl.h>

namespace throng::render {

/// During the lifetime of this object, draws blend both sides of triangles into the color buffer by
/// alpha and change neither depth nor other buffers.
class ColorOnly {
 public:
  ColorOnly() {
    allow(false);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  }
  ~ColorOnly() {
    glDisable(GL_BLEND);
    allow(true);
  }
  ColorOnly(const ColorOnly&) = delete;
  ColorOnly& operator=(const ColorOnly&) = delete;

 private:
  static void allow(bool others) {
    constexpr GLuint kMaxAttachments = 8;
    const GLboolean on = others ? GL_TRUE : GL_FALSE;
    glDepthMask(on);
    for (GLuint i = 1; i < kMaxAttachments; ++i) glColorMaski(i, on, on, on, on);
  }
};

}  // namespace throng::render
