// Renders the sky where nothing else is, and rain between the camera and everything.
#pragma once

#include <string>

#include "camera/camera.h"
#include "render/gl/gl_objects.h"
#include "spec/render/environment.h"

namespace throng::render {

class SkyPass {
 public:
  explicit SkyPass(const Environment& environment);

  /// Fills what is infinitely far. Expects the View and Light blocks and the target to be bound;
  /// touches the color only.
  void draw_sky(const camera::Camera& camera) const;

  /// Drops as the streaks that they leave in 1/60 s. `frame` decides where they fall. Does nothing
  /// unless it rains; touches the color only.
  void draw_rain(const camera::Camera& camera, std::int64_t frame) const;

 private:
  Environment environment_;
  VertexArray nothing_;  ///< GL wants one bound, though vertices are made in the shader
  Program sky_;
  Program rain_;
};

}  // namespace throng::render
