// Everything in the world at one instant, as the renderer takes it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "camera/camera.h"
#include "render/props/airframe_mesh.h"
#include "skinning/animate/action.h"
#include "skinning/animate/motion.h"
#include "skinning/appearance.h"

namespace throng::render {

/// One person as rendered: where, which body, which pose.
struct PersonInstance {
  std::uint32_t agent = 0;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Vector2f velocity = Eigen::Vector2f::Zero();
  float yaw_rad = 0;
  skinning::Appearance appearance;
  skinning::PoseBlend pose;
  skinning::Actions actions = {};  ///< that the pose is part of
};

/// Everything that is in the world at one instant.
struct Scene {
  std::int64_t index = 0;  ///< becomes Frame::index
  double time_s = 0;
  std::vector<PersonInstance> people;
  std::vector<Eigen::Vector2f> dangers;  ///< where what people run from is (m)
  /// Also that of the camera, which does not see itself.
  std::vector<DroneInstance> drones = {};
};

/// The next or the previous frame of the same camera: what flow leads to.
struct NeighborFrame {
  Scene scene;
  camera::Camera camera;
};

}  // namespace throng::render
