// Smoke that rises from dangers, and the dust about them, as soft discs that face the camera.
#pragma once

#include <array>
#include <vector>

#include "render/environment.h"
#include "render/gl_objects.h"
#include "render/renderer.h"

namespace throng::render {

class SmokePass {
 public:
  explicit SmokePass(const Environment& environment);

  /// Changes the colours alone: nobody's outline or depth. Expects the View and Light blocks and
  /// the target to be bound and everything solid to be drawn. Does nothing without smoke.
  void draw(const Scene& scene, const camera::Camera& camera);

 private:
  /// One disc, as shaders/smoke.vert.glsl reads it.
  struct Puff {
    std::array<float, 4> place{};  ///< middle and radius (m)
    std::array<float, 4> look{};   ///< linear albedo, how much of what is behind it hides
    float depth_m = 0;             ///< of the camera
  };
  void add_puffs(const Eigen::Vector2d& danger, std::size_t number, double time_s,
                 const camera::Camera& camera);

  Environment environment_;
  std::vector<Puff> puffs_;  ///< of the frame
  Buffer instances_;
  VertexArray array_;
  Program program_;
};

}  // namespace throng::render
