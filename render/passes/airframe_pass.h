// Renders the drones in view, except the one that carries the camera.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "camera/camera.h"
#include "render/gl/gl_objects.h"
#include "render/light/probe_grid.h"
#include "render/props/airframe_mesh.h"
#include "spec/render/quality.h"

namespace throng::render {

class AirframePass {
 public:
  /// `words` are light_words() of the environment. Drones take the light of `air`, which must
  /// outlive this object. The current context must stay current in all calls.
  AirframePass(std::string_view words, const QualitySettings& quality, const ProbeGrid& air);

  /// Expects the same bindings as SceneryPass::draw(). Drones cast no shadows, since the sun's
  /// width blurs them at usual heights.
  void draw(const std::vector<DroneInstance>& drones, const camera::Camera& camera);

 private:
  void prepare();

  const ProbeGrid& air_;
  std::string words_;
  bool has_shadows_;
  bool is_prepared_ = false;  ///< false until a drone is in view, as never in jobs with one drone
  Buffer vertices_;
  Buffer indices_;
  VertexArray array_;
  Program program_;
};

}  // namespace throng::render
