// The moving content of the world at one time, the input of the renderer.
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

/// A person to be rendered: position (m) and velocity (m/s) on the ground, character and pose.
struct PersonInstance {
  std::uint32_t agent = 0;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Vector2f velocity = Eigen::Vector2f::Zero();
  float yaw_rad = 0;
  skinning::Appearance appearance;
  skinning::PoseBlend pose;
  skinning::Actions actions = {};  ///< actions to which the pose belongs
};

/// People, dangers and drones at one time.
struct Scene {
  std::int64_t index = 0;  ///< becomes Frame::index
  double time_s = 0;
  std::vector<PersonInstance> people;
  std::vector<Eigen::Vector2f> dangers;  ///< positions of the agents from which people flee (m)
  /// All drones, including the one that carries the camera, which is not rendered.
  std::vector<DroneInstance> drones = {};
};

/// The next or the previous frame of the same camera, to which optical flow leads.
struct NeighborFrame {
  Scene scene;
  camera::Camera camera;
};

}  // namespace throng::render
