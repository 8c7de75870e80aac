// Renders the drones that a camera may see: all but the one that it hangs from.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "camera/camera.h"
#include "render/gl/gl_objects.h"
#include "render/props/airframe_mesh.h"
#include "spec/render/quality.h"

namespace throng::render {

class AirframePass {
 public:
  /// `words` are the environment's of render/scenery/lighting.h. Needs the current context from
  /// then on.
  AirframePass(std::string_view words, const QualitySettings& quality);

  /// Expects what SceneryPass::draw() expects. Drones cast no shadows: at the heights they fly at,
  /// the sun's width blurs theirs away.
  void draw(const std::vector<DroneInstance>& drones, const camera::Camera& camera);

 private:
  void prepare();

  std::string words_;
  bool has_shadows_;
  bool is_prepared_ = false;  ///< most jobs have one drone, and need nothing of this
  Buffer vertices_;
  Buffer indices_;
  VertexArray array_;
  Program program_;
};

}  // namespace throng::render
