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
#include "render/scenery/railings.h"
#include "render/scenery/rubble.h"
#include "render/scenery/scenery.h"
#include "render/scenery/scenery_classes.h"
#include "render/scenery/stands.h"
#include "render/scenery/surface_classes.h"
#include "render/scenery/tracks.h"
#include "render/scenery/water.h"
#include "world/stand_seats.h"

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
    if (has_no_walls(scenario.buildings[i])) continue;
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

/// Numbers what is placed, one after the other.
class PropIds {
 public:
  explicit PropIds(bool semantic) : semantic_(semantic) {}

  /// The present one, with a class.
  std::uint32_t now(world::SemanticClass value) const {
    return semantic_ ? id_with_class(id_, value) : id_;
  }
  void next() { ++id_; }

 private:
  bool semantic_;
  std::uint32_t id_ = kIdProp;
};

/// Moves a mesh to the surface below it: the water's.
void sink(double level_m, PropMesh& mesh) {
  for (PropVertex& vertex : mesh.vertices) vertex.position[2] += static_cast<float>(level_m);
}

void add_all(std::vector<PropMesh> meshes, const PlacedProp& like, std::vector<PlacedProp>& props) {
  for (PropMesh& mesh : meshes) {
    if (mesh.indices.empty()) continue;
    props.push_back(like);
    props.back().mesh = std::move(mesh);
  }
}

/// Adds stands, tracks, and water with its banks and bridges.
void add_structures(const world::Scenario& scenario, PropIds& ids, std::vector<PlacedProp>& props) {
  for (const world::Stand& stand : scenario.stands) {
    if (!stand.band.empty()) continue;
    add_all(make_stand(stand, ids.now(world::SemanticClass::stands)),
            {.mesh = {}, .is_detail = true}, props);
    ids.next();
  }
  for (const world::Marking& marking : scenario.markings) {
    if (marking.kind != "track") continue;
    add_all(make_track(marking, ids.now(world::SemanticClass::railway)),
            {.mesh = {}, .casts = false, .is_detail = true}, props);
    ids.next();
  }
  for (std::size_t i = 0; i < scenario.areas.size(); ++i) {
    const world::GroundArea& water = scenario.areas[i];
    if (water.material != "water") continue;
    add_all({water_surface(water, ids.now(world::SemanticClass::water))},
            {.mesh = {}, .casts = false}, props);
    ids.next();
    add_all(quay_walls(scenario, water, ids.now(world::SemanticClass::bridge)), {}, props);
    ids.next();
    for (std::size_t k = i + 1; k < scenario.areas.size(); ++k) {
      PropMesh bridge =
          bridge_below(scenario.areas[k], water, ids.now(world::SemanticClass::bridge));
      if (bridge.indices.empty()) continue;
      props.push_back({.mesh = std::move(bridge)});
      ids.next();
    }
  }
}

/// The land beyond the ground on which no houses stand: below meshes, stands and water.
std::vector<Eigen::AlignedBox2d> taken_land(const world::Scenario& scenario,
                                            std::vector<Eigen::AlignedBox2d> taken) {
  const auto take = [&](const auto& corners) {
    Eigen::AlignedBox2d& box = taken.emplace_back();
    for (const Eigen::Vector2d& corner : corners) box.extend(corner);
  };
  for (const world::Stand& stand : scenario.stands) take(world::stand_outline(stand));
  for (const world::GroundArea& area : scenario.areas) {
    if (area.material == "water") take(area.corners);
  }
  return taken;
}

std::vector<PlacedProp> place_props(const world::Scenario& scenario, bool semantic) {
  std::vector<PlacedProp> props;
  std::vector<Eigen::AlignedBox2d> taken;
  PropIds ids(semantic);
  const bool has_water = !world::water_parts(scenario.areas).empty();
  for (const world::Prop& prop : scenario.props) {
    PropMesh mesh = prop_shape(prop, ids.now(world::prop_type(prop.kind).semantic_class));
    if (has_water) sink(world::surface_level_m(scenario.areas, prop.position), mesh);
    props.push_back({.mesh = std::move(mesh)});
    ids.next();
  }
  for (const world::PlacedMesh& mesh : scenario.meshes) {
    props.push_back({.mesh = mesh_from_file(mesh, ids.now(mesh.semantic_class)), .closed = false});
    taken.push_back(mesh_outline(props.back().mesh));
    ids.next();
  }
  add_structures(scenario, ids, props);
  for (const world::Disaster& disaster : scenario.disasters) {
    std::vector<RubblePiece> pieces = make_rubble(disaster, ids.now(world::SemanticClass::rubble));
    for (RubblePiece& piece : pieces) {
      props.push_back({.mesh = std::move(piece.mesh), .from_s = piece.from_s});
    }
    if (!pieces.empty()) ids.next();
  }
  add_building_details(scenario, semantic, props);
  // Walls of hedges throw the shadows of their leaves, and nobody sees those of the land beyond.
  add_all(hedge_leaves(scenario, semantic), {.mesh = {}, .casts = false}, props);
  add_all(railings(scenario, semantic), {.mesh = {}, .is_detail = true}, props);
  add_all(far_land(scenario, taken_land(scenario, std::move(taken))),
          {.mesh = {}, .casts = false, .is_backdrop = true}, props);
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
