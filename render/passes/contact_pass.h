// Contact shadows: dark rims on the ground around people and the feet of props, finer than the
// baked light (render/light). Without them, objects in the shade seem to float.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/frame/view.h"
#include "render/gl/gl_objects.h"
#include "render/props/scene.h"
#include "render/scenery/daylight.h"
#include "render/scenery/lamps.h"
#include "world/scenario.h"

namespace throng::render {

class ContactPass {
 public:
  ContactPass(const world::Scenario& scenario, const Daylight& light);

  /// Darkens the ground in the color buffer only. Expects the View and Light blocks and the target
  /// to be bound, and the ground to be rendered. Skips people smaller than a few pixels.
  void draw(std::span<const PersonInstance> people, const camera::Camera& camera);

 private:
  /// One instance, as shaders/contact.vert.glsl reads it.
  struct Rim {
    std::array<float, 4> footprint{};  ///< center, half sizes (m)
    std::array<float, 4> shade{};      ///< heading's cosine and sine, reach (m), strength
    float rounding_m = 0;              ///< radius of the footprint's corners
  };
  static Rim rim(const Eigen::Vector2d& middle, const Eigen::Vector2d& half_size, double yaw_rad,
                 double reach_m, double strength);

  /// Adds the soft shadows that the lamps around a person cast on the ground.
  void add_lamp_shadows(const PersonInstance& person);

  std::vector<Lamp> lamps_;  ///< empty by day
  std::vector<Rim> still_;   ///< rims of props
  std::vector<Rim> rims_;    ///< rims of the current frame
  double strength_;
  Buffer instances_;
  VertexArray array_;
  Program program_;
};

}  // namespace throng::render
