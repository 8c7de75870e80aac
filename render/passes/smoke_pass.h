// Renders smoke, flames, gas and dust of hazards as soft discs (puffs) that face the camera.
#pragma once

#include <array>
#include <vector>

#include "render/frame/frame.h"
#include "render/gl/gl_objects.h"
#include "render/light/probe_grid.h"
#include "render/props/scene.h"
#include "spec/render/environment.h"
#include "world/disasters.h"

namespace throng::render {

class SmokePass {
 public:
  /// Smoke rises from the growing disasters or, in a scenario without described disasters, from all
  /// Scene::dangers at all times.
  /// It takes the light of `air`, which must outlive this object.
  SmokePass(const Environment& environment, std::vector<world::Disaster> disasters,
            const ProbeGrid& air);

  /// Changes only colors. Expects the View and Light blocks and the target to be bound, and all
  /// solid objects to be rendered. Does nothing without smoke.
  void draw(const Scene& scene, const camera::Camera& camera);

  /// Draws the opacity of each HazardMatter into an OpacityTarget.
  void draw_opacity(const Scene& scene, const camera::Camera& camera);

 private:
  /// One disc, as shaders/smoke.vert.glsl reads it.
  struct Puff {
    std::array<float, 4> place{};  ///< center and radius (m)
    /// Linear albedo and opacity; of flames: heat (0 to 1), 0, 0 and opacity + 2.
    std::array<float, 4> look{};
    float depth_m = 0;             ///< the camera's z
    float kind = 0;                ///< HazardMatter
    std::array<float, 3> above{};  ///< light from above and from below
    std::array<float, 3> below{};
  };
  /// Shared properties of the puffs of one hazard.
  struct Source {
    Eigen::Vector2d place;
    double age_s = 0;        ///< time since its start, the max age of puffs
    double reach_m = 0;      ///< spread in addition to that of a small fire
    double rise = 1;         ///< speed of rising, relative to a fire's smoke
    std::uint64_t dust = 0;  ///< number of puffs that stay on the ground
    Eigen::Vector3d smoke_albedo;
    Eigen::Vector3d dust_albedo;
    HazardMatter matter = HazardMatter::smoke;
  };
  /// Adds flames at the base of a fire, and of an explosion while its fireball lasts.
  void add_flames(const world::Disaster& disaster, std::size_t number, double time_s,
                  const camera::Camera& camera);
  static Source smoke_source(const world::Disaster& disaster, double time_s);
  void add_puffs(const Source& source, std::size_t number, double time_s,
                 const camera::Camera& camera);

  /// Fills puffs_, the farthest first, and uploads them to the device.
  void upload(const Scene& scene, const camera::Camera& camera);
  void draw_discs(const Program& program) const;

  const ProbeGrid& air_;
  Environment environment_;
  std::vector<world::Disaster> disasters_;
  std::vector<Puff> puffs_;  ///< puffs of the current frame
  Buffer instances_;
  VertexArray array_;
  Program program_;
  Program opacity_;
};

}  // namespace throng::render
