// Quadcopters as others see them: a procedural body, four arms, motors, blades, skids and a camera.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "render/props/prop_shapes.h"

namespace throng::render {

/// Parameters of a quadcopter's appearance (spec/sim/airframe.h has all of them).
struct AirframeShape {
  double arm_m = 0;               ///< center to rotor axis
  double height_m = 0;            ///< of the body
  double propeller_radius_m = 0;  ///< half a blade pair
  /// Radius of a sphere about the center that holds everything.
  double reach_m() const { return 1.1 * (arm_m + propeller_radius_m) + height_m; }
};

/// One drone at one instant.
struct DroneInstance {
  std::uint32_t drone = 0;  ///< number in the run's trace
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
  AirframeShape shape;
};

/// The quadcopter in the world, with its id of the id buffer. Blades stand still: while they spin a
/// camera sees little of them.
PropMesh airframe_mesh(const DroneInstance& drone);

/// Whether a camera with its center here hangs from this drone, and therefore sees nothing of it.
inline bool carries(const DroneInstance& drone, const Eigen::Vector3d& camera_center) {
  return (drone.position - camera_center).norm() < drone.shape.arm_m;
}

}  // namespace throng::render
