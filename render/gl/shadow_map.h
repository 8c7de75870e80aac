// The shadow map, a depth texture; see lighting.h for its layout.
#pragma once

#include "render/gl/gl_objects.h"

namespace throng::render {

class ShadowMap {
 public:
  /// `texels` along each side; 0 makes a map without shadows, which must not be rendered into.
  explicit ShadowMap(int texels);

  /// Binds the map for drawing and clears it.
  void begin() const;

  /// Binds the map for shaders/light.glsl.
  void bind() const;

 private:
  int texels_;
  Texture depth_;
  Sampler heights_;  ///< samples heights without comparison
  Framebuffer framebuffer_;
};

}  // namespace throng::render
