// The depth texture that shadows are looked up in; see lighting.h for its layout.
#pragma once

#include "render/gl/gl_objects.h"

namespace throng::render {

class ShadowMap {
 public:
  /// `texels` along each side; 0 makes a map in which everything is lit, not to be rendered into.
  explicit ShadowMap(int texels);

  /// Binds it for drawing, empty.
  void begin() const;

  /// Binds it for the look-ups of shaders/light.glsl.
  void bind() const;

 private:
  int texels_;
  Texture depth_;
  Sampler heights_;  ///< reads them without comparison
  Framebuffer framebuffer_;
};

}  // namespace throng::render
