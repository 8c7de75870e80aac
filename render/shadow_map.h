// The depth texture that shadows are looked up in; see lighting.h for its layout.
#pragma once

#include "render/gl_objects.h"

namespace throng::render {

class ShadowMap {
 public:
  ShadowMap();

  /// Binds it for drawing, empty.
  void begin() const;

  /// Binds it for the look-ups of shaders/light.glsl.
  void bind() const;

 private:
  Texture depth_;
  Framebuffer framebuffer_;
};

}  // namespace throng::render
