#include "render/scenery/scenery_classes.h"

#include <array>
#include <map>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "render/buildings/building_mesh.h"
#include "render/scenery/surface_classes.h"

namespace throng::render {

namespace {

using world::SemanticClass;

SemanticClass class_of_ground(std::string_view material) {
  constexpr std::array<std::pair<std::string_view, SemanticClass>, 10> kClasses = {{
      {"pavers", SemanticClass::pavement},
      {"concrete", SemanticClass::pavement},
      {"setts", SemanticClass::pavement},
      {"tactile", SemanticClass::pavement},
      {"gutter", SemanticClass::road},
      {"asphalt", SemanticClass::road},
      {"grass", SemanticClass::grass},
      {"dirt", SemanticClass::dirt},
      {"kerb", SemanticClass::kerb},
      {"paint", SemanticClass::marking},
  }};
  for (const auto& [name, value] : kClasses) {
    if (name == material) return value;
  }
  check(false, "every ground material has a class");
  return SemanticClass::terrain;
}

bool has_look(const SceneryVertex& vertex, WallLook look) {
  return vertex.facade == static_cast<float>(look);
}

SemanticClass class_of_wall(const SceneryVertex& vertex) {
  constexpr std::size_t kHeight = 3;  // of SceneryVertex::local
  if (vertex.facade == static_cast<float>(world::Facade::hedge)) return SemanticClass::hedge;
  if (has_look(vertex, WallLook::open_door) || has_look(vertex, WallLook::closed_door)) {
    return SemanticClass::door;
  }
  const bool is_upper = has_look(vertex, WallLook::gable) ||
                        has_look(vertex, WallLook::brick_gable) ||
                        has_look(vertex, WallLook::glazing);
  const bool has_stories = vertex.local[kHeight] >= kMinStoryM ||
                           vertex.facade == static_cast<float>(world::Facade::glass);
  return is_upper || has_stories ? SemanticClass::building : SemanticClass::wall;
}

SemanticClass class_of_roof(const SceneryVertex& vertex) {
  if (vertex.facade == static_cast<float>(RoofLook::hedge)) return SemanticClass::hedge;
  if (vertex.facade == static_cast<float>(RoofLook::wall_top)) return SemanticClass::wall;
  return SemanticClass::roof;
}

/// Classifies the vertices of a range, which no other range uses.
template <typename ClassOf>
void classify(const Range& range, SceneryMesh& mesh, const ClassOf& semantic_class) {
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    SceneryVertex& vertex = mesh.vertices[mesh.indices[i]];
    vertex.id = id_with_class(vertex.id, semantic_class(vertex));
  }
}

/// Gives a range vertices of its own.
void separate(const Range& range, SceneryMesh& mesh) {
  std::map<std::uint32_t, std::uint32_t> copies;
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [copy, is_new] = copies.try_emplace(mesh.indices[i], next);
    if (is_new) mesh.vertices.push_back(SceneryVertex(mesh.vertices[mesh.indices[i]]));
    mesh.indices[i] = copy->second;
  }
}

}  // namespace

void add_classes(const world::Scenario& scenario, const std::vector<GroundLayer>& layers,
                 SceneryMesh& mesh) {
  const auto all = [](SemanticClass value) {
    return [value](const SceneryVertex& /*vertex*/) { return value; };
  };
  classify(mesh.walls, mesh, class_of_wall);
  classify(mesh.roofs, mesh, class_of_roof);
  separate(mesh.surroundings, mesh);
  classify(mesh.surroundings, mesh, all(SemanticClass::terrain));
  classify(mesh.ground, mesh, all(class_of_ground(scenario.ground_material)));
  for (const GroundLayer& layer : layers) {
    classify(layer.range, mesh, all(class_of_ground(layer.material)));
  }
}

}  // namespace throng::render
