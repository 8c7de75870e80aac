#include "render/props/vehicles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "render/frame/frame.h"
#include "render/props/mesh_file.h"

namespace throng::render {

namespace {

/// The middle of the foot of the upright box around a mesh, turned as it heads.
Eigen::Vector3d foot_offset(const PropMesh& mesh, double yaw_rad) {
  const Eigen::AngleAxisd turn(yaw_rad, Eigen::Vector3d::UnitZ());
  Eigen::AlignedBox3d box;
  for (const PropVertex& vertex : mesh.vertices) {
    const Eigen::Map<const Eigen::Vector3f> at(vertex.position.data());
    box.extend(Eigen::Vector3d(turn.inverse() * at.cast<double>()));
  }
  if (box.isEmpty()) return Eigen::Vector3d::Zero();
  return turn * Eigen::Vector3d(box.center().x(), box.center().y(), box.min().z());
}

}  // namespace

std::size_t vehicle_count(const world::Scenario& scenario) {
  const auto props =
      std::count_if(scenario.props.begin(), scenario.props.end(), [](const world::Prop& prop) {
        return world::is_vehicle(world::prop_type(prop.kind).semantic_class);
      });
  const auto meshes = std::count_if(
      scenario.meshes.begin(), scenario.meshes.end(),
      [](const world::PlacedMesh& mesh) { return world::is_vehicle(mesh.semantic_class); });
  return static_cast<std::size_t>(props + meshes);
}

std::vector<Vehicle> list_vehicles(const world::Scenario& scenario) {
  std::vector<Vehicle> vehicles;
  std::uint32_t id = kIdProp;
  for (const world::Prop& prop : scenario.props) {
    const world::SemanticClass surface = world::prop_type(prop.kind).semantic_class;
    if (world::is_vehicle(surface)) {
      vehicles.push_back({id, surface, Eigen::Vector3d(prop.position.x(), prop.position.y(), 0),
                          prop.yaw_rad, prop_shape(prop, id)});
    }
    ++id;
  }
  for (const world::PlacedMesh& mesh : scenario.meshes) {
    if (world::is_vehicle(mesh.semantic_class)) {
      PropMesh shape = mesh_from_file(mesh, id);
      const Eigen::Vector3d foot = foot_offset(shape, mesh.yaw_rad);
      vehicles.push_back({id, mesh.semantic_class, foot, mesh.yaw_rad, std::move(shape)});
    }
    ++id;
  }
  return vehicles;
}

}  // namespace throng::render
