// The vehicles of a scenario: parked motor vehicles and trains.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/props/prop_shapes.h"
#include "world/scenario.h"

namespace throng::render {

/// A vehicle, with ground truth.
struct Vehicle {
  std::uint32_t id = 0;  ///< value in the id buffer
  world::SemanticClass surface{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< center on the ground, m
  double yaw_rad = 0;
  PropMesh mesh;  ///< in the world's frame
};

/// The size of list_vehicles() without reading meshes.
std::size_t vehicle_count(const world::Scenario& scenario);

/// The props and meshes that are vehicles, by id. Throws InputError for a mesh file that
/// cannot be read.
std::vector<Vehicle> list_vehicles(const world::Scenario& scenario);

}  // namespace throng::render
