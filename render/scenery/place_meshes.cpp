#include "render/scenery/place_meshes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "render/buildings/building_mesh.h"
#include "render/buildings/facade_details.h"
#include "render/buildings/roof_details.h"
#include "render/frame/frame.h"
#include "render/ground/ground_decals.h"
#include "render/props/mesh_file.h"
#include "render/props/prop_shapes.h"
#include "render/scenery/far_land.h"
#include "render/scenery/hedges.h"
#include "render/scenery/rubble.h"
#include "render/scenery/scenery.h"
#include "render/scenery/scenery_classes.h"
#include "render/scenery/surface_classes.h"

namespace throng::render {

namespace {

Eigen::AlignedBox2d mesh_outline(const PropMesh& mesh) {
  Eigen::AlignedBox2d outline;
  for (const PropVertex& vertex : mesh.vertices) {
    outline.extend(Eigen::Vector2d(vertex.position[0], vertex.position[1]));
  }
  return outline;
}

/// Adds what is on the buildings, on their fronts only near where people are.
void add_building_details(const world::Scenario& scenario, bool semantic,
                          std::vector<PlacedProp>& props) {
  constexpr double kFrontsWithinM = 70;
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    const BuildingModel model = building_model(scenario.buildings[i], i);
    const auto id_of = [&](world::SemanticClass value) {
      return semantic ? id_with_class(kIdBuilding + i, value) : kIdBuilding + i;
    };
    const auto add = [&](PropMesh mesh) {
      if (!mesh.indices.empty()) props.push_back({.mesh = std::move(mesh), .is_detail = true});
    };
    add(roof_details(model, id_of(world::SemanticClass::roof)));
    const auto& footprint = model.building.footprint;
    const bool is_near = std::any_of(footprint.begin(), footprint.end(), [&](const auto& corner) {
      return (scenario.inside.bounds.nearest_point(corner, 0) - corner).norm() < kFrontsWithinM;
    });
    if (!is_near) continue;
    add(facade_details(model, scenario, id_of(world::SemanticClass::building),
                       id_of(world::SemanticClass::roof)));
  }
}

std::vector<PlacedProp> place_props(const world::Scenario& scenario, bool semantic) {
  std::vector<PlacedProp> props;
  std::vector<Eigen::AlignedBox2d> taken;
  std::uint32_t id = kIdProp;
  const auto id_of = [&](world::SemanticClass value) {
    return semantic ? id_with_class(id, value) : id;
  };
  for (const world::Prop& prop : scenario.props) {
    props.push_back({.mesh = prop_shape(prop, id_of(world::prop_type(prop.kind).semantic_class))});
    ++id;
  }
  for (const world::PlacedMesh& mesh : scenario.meshes) {
    props.push_back({.mesh = mesh_from_file(mesh, id_of(mesh.semantic_class)), .closed = false});
    taken.push_back(mesh_outline(props.back().mesh));
    ++id;
  }
  for (const world::Disaster& disaster : scenario.disasters) {
    std::vector<RubblePiece> pieces = make_rubble(disaster, id_of(world::SemanticClass::rubble));
    for (RubblePiece& piece : pieces) {
      props.push_back({.mesh = std::move(piece.mesh), .from_s = piece.from_s});
    }
    if (!pieces.empty()) ++id;
  }
  add_building_details(scenario, semantic, props);
  // Walls of hedges throw the shadows of their leaves, and nobody sees those of the land beyond.
  for (PropMesh& mesh : hedge_leaves(scenario, semantic)) {
    props.push_back({.mesh = std::move(mesh), .casts = false});
  }
  for (PropMesh& mesh : far_land(scenario, taken)) {
    props.push_back({.mesh = std::move(mesh), .casts = false, .is_backdrop = true});
  }
  return props;
}

}  // namespace

PlaceMeshes place_meshes(const world::Scenario& scenario, bool semantic) {
  PlaceMeshes meshes;
  meshes.scenery = scenery_mesh(scenario);
  meshes.layers = add_ground_layers(scenario, meshes.scenery);
  if (semantic) add_classes(scenario, meshes.layers, meshes.scenery);
  add_ground_decals(ground_decals(scenario), meshes.scenery);
  meshes.props = place_props(scenario, semantic);
  return meshes;
}

}  // namespace throng::render
