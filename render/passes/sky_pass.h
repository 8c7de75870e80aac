// Renders the sky in the background, and rain in the foreground.
#pragma once

#include <string>

#include "camera/camera.h"
#include "render/gl/gl_objects.h"
#include "spec/render/environment.h"

namespace throng::render {

class SkyPass {
 public:
  explicit SkyPass(const Environment& environment);

  /// Fills pixels with infinite depth. Expects the View and Light blocks and the target to be
  /// bound. Changes only colors.
  void draw_sky(const camera::Camera& camera) const;

  /// Draws raindrops as their streaks in 1/60 s. `frame` determines their positions. Does nothing
  /// unless it rains. Changes only colors.
  void draw_rain(const camera::Camera& camera, std::int64_t frame) const;

 private:
  Environment environment_;
  VertexArray nothing_;  ///< GL requires a bound array although the shader makes the vertices
  Program sky_;
  Program rain_;
};

}  // namespace throng::render
