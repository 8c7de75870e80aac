#include "render/scenery/place_meshes.h"

#include <Eigen/Geometry>
#include <utility>

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

std::vector<PlacedProp> place_props(const world::Scenario& scenario, bool semantic) {
  std::vector<PlacedProp> props;
  std::vector<Eigen::AlignedBox2d> taken;
  std::uint32_t id = kIdProp;
  const auto id_of = [&](world::SemanticClass value) {
    return semantic ? id_with_class(id, value) : id;
  };
  for (const world::Prop& prop : scenario.props) {
    props.push_back({.mesh = prop_shape(prop, id_of(world::semantic_class(prop.kind)))});
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
