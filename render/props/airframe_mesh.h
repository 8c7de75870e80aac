// Procedural meshes of quadcopters: body, four arms, motors, blades, skids and a camera.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "render/props/prop_shapes.h"
#include "spec/sim/airframe.h"

namespace throng::render {

/// The dimensions of a quadcopter that affect its appearance.
struct AirframeShape {
  double arm_m = 0;                           ///< from the center to the farthest rotor's axis
  double height_m = 0;                        ///< height of the body
  double propeller_radius_m = 0;              ///< half the length of a pair of blades
  std::array<Eigen::Vector2d, 4> rotors_m{};  ///< their axes, x ahead, y left
  /// Radius of a bounding sphere around the center.
  double reach_m() const { return 1.1 * (arm_m + propeller_radius_m) + height_m; }
};

AirframeShape airframe_shape(const sim::Airframe& airframe);

/// One drone at one time (m, m/s, world).
struct DroneInstance {
  std::uint32_t drone = 0;  ///< index in the run's trace
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
  AirframeShape shape;
};

/// The quadcopter's mesh in the world, with its id for the id buffer. Blades do not rotate, since
/// spinning blades are hardly visible.
PropMesh airframe_mesh(const DroneInstance& drone);

/// Whether a camera with this center is mounted on the drone, which it therefore does not see.
inline bool carries(const DroneInstance& drone, const Eigen::Vector3d& camera_center) {
  return (drone.position - camera_center).norm() < drone.shape.reach_m();
}

}  // namespace throng::render
