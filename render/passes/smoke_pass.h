// Smoke that rises from dangers, and the dust about them, as soft discs that face the camera.
#pragma once

#include <array>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/scene.h"
#include "spec/render/environment.h"
#include "world/disasters.h"

namespace throng::render {

class SmokePass {
 public:
  /// Smoke rises from the disasters as they grow; in a scenario that describes none, from all
  /// dangers and all the time.
  SmokePass(const Environment& environment, std::vector<world::Disaster> disasters);

  /// Changes the colors alone: nobody's outline or depth. Expects the View and Light blocks and
  /// the target to be bound and everything solid to be rendered. Does nothing without smoke.
  void draw(const Scene& scene, const camera::Camera& camera);

  /// Into an OpacityTarget: how much of what is behind it each kind hides.
  void draw_opacity(const Scene& scene, const camera::Camera& camera);

 private:
  /// One disc, as shaders/smoke.vert.glsl reads it.
  struct Puff {
    std::array<float, 4> place{};  ///< middle and radius (m)
    /// Linear albedo, how much of what is behind it hides; what shines by itself: radiance, that
    /// + 2.
    std::array<float, 4> look{};
    float depth_m = 0;  ///< of the camera
    float kind = 0;     ///< HazardMatter
  };
  /// Shared properties of the puffs of one hazard.
  struct Source {
    Eigen::Vector2d place;
    double age_s = 0;        ///< older puffs have not been
    double reach_m = 0;      ///< how wide it is spread beyond what a small fire has
    double rise = 1;         ///< of how a fire's smoke rises
    std::uint64_t dust = 0;  ///< how many puffs stay on the ground
    Eigen::Vector3d smoke_albedo;
    Eigen::Vector3d dust_albedo;
    HazardMatter matter = HazardMatter::smoke;
  };
  /// Flames at the foot of a fire, and of an explosion for as long as its fireball lasts.
  void add_flames(const world::Disaster& disaster, std::size_t number, double time_s,
                  const camera::Camera& camera);
  static Source smoke_source(const world::Disaster& disaster, double time_s);
  void add_puffs(const Source& source, std::size_t number, double time_s,
                 const camera::Camera& camera);

  /// Fills puffs_, the farthest first, and gives them to the device.
  void upload(const Scene& scene, const camera::Camera& camera);
  void draw_discs(const Program& program) const;

  Environment environment_;
  std::vector<world::Disaster> disasters_;
  std::vector<Puff> puffs_;  ///< of the frame
  Buffer instances_;
  VertexArray array_;
  Program program_;
  Program opacity_;
};

}  // namespace throng::render
