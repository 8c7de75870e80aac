// Renders what shines in the air of concerts after sunset: beams of moving lights in the haze of
// the stage, and screens of phones before it.
#pragma once

#include <array>
#include <vector>

#include "camera/camera.h"
#include "render/gl/gl_objects.h"
#include "render/props/scene.h"
#include "render/props/shape_file.h"
#include "world/scenario.h"

namespace throng::render {

class BeamPass {
 public:
  /// Takes the beams (ShapeBeam) of the scenario's props; `lamps_on` after sunset. `words` are
  /// light_words() of the environment.
  BeamPass(const world::Scenario& scenario, bool lamps_on, std::string_view words);

  /// Changes only colors. Expects the View and Light blocks and the target to be bound, and all
  /// solid objects to be rendered. Does nothing by day and in places without beams.
  void draw(const Scene& scene);

 private:
  /// A streak of light, as shaders/beam.vert.glsl reads it.
  struct Streak {
    std::array<float, 4> from{};   ///< its start and its radius there (m)
    std::array<float, 4> to{};     ///< its end and its radius there (m)
    std::array<float, 4> color{};  ///< in units of lamp light, then the share that its end keeps
  };
  void add_beams(double time_s);
  void add_phones(const Scene& scene);

  std::vector<ShapeBeam> beams_;         ///< in the world
  std::vector<Eigen::Vector2d> stages_;  ///< positions of the props that have them
  std::vector<Streak> streaks_;
  Buffer instances_;
  VertexArray array_;
  Program program_;
};

}  // namespace throng::render
