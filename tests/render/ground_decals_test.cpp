// Traces of use on the ground, its worked edges, and what they leave alone.
#include "render/ground/ground_decals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "render/ground/ground_layers.h"
#include "render/ground/ground_map.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using Eigen::Vector2d;

/// A square of pavers with houses, a road with a crossing, a lawn with a kerb, and props.
world::Scenario lively_place() {
  world::Scenario scenario = open_ground({block(-30, -20, -8, 8, 9), block(-20, 0, 30, 36, 12)});
  scenario.ground_material = "pavers";
  scenario.areas.push_back({{{-40, -25}, {40, -25}, {40, -18}, {-40, -18}}, "asphalt", false});
  scenario.areas.push_back({{{12, 2}, {32, 2}, {32, 22}, {12, 22}}, "grass", true});
  scenario.areas.push_back({{{-40, 26}, {-22, 26}, {-22, 40}, {-40, 40}}, "grass", false});
  scenario.markings.push_back({"crossing", {0, -24.7}, {0, -18.3}, 4});
  using world::PropKind;
  const std::array kinds = {PropKind::tree,  PropKind::bench, PropKind::bin,     PropKind::car,
                            PropKind::stall, PropKind::kiosk, PropKind::fountain};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    world::Prop prop;
    prop.kind = kinds.at(i);
    prop.position = {-14.0 + 6.0 * static_cast<double>(i), -10};
    if (prop.kind == PropKind::car) prop.position.y() = -20;
    scenario.props.push_back(prop);
  }
  return scenario;
}

TEST(GroundDecals, FollowFromTheScenarioAlone) {
  const auto first = ground_decals(lively_place());
  const auto second = ground_decals(lively_place());
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].kind, second[i].kind);
    EXPECT_EQ(first[i].middle, second[i].middle);
    EXPECT_EQ(first[i].half_size, second[i].half_size);
    EXPECT_EQ(first[i].along, second[i].along);
  }
}

TEST(GroundDecals, LieOnTheGroundOutsideOfBuildings) {
  const world::Scenario scenario = lively_place();
  std::set<DecalKind> kinds;
  const auto decals = ground_decals(scenario);
  EXPECT_LE(decals.size(), kMaxDecals);
  for (const GroundDecal& decal : decals) {
    kinds.insert(decal.kind);
    EXPECT_TRUE(scenario.ground.contains(decal.middle)) << decal.middle.transpose();
    for (const world::Building& building : scenario.buildings) {
      EXPECT_GE(geometry::signed_distance_to(building.footprint, decal.middle), 0);
    }
    EXPECT_GE(decal.half_size.x(), decal.half_size.y());
    EXPECT_NEAR(decal.along.norm(), 1, 1e-9);
  }
  using enum DecalKind;
  for (const DecalKind kind : {manhole, drain, patch, slabs, stain, tracks, soil, wet, shade,
                               leaves, litter, gum, daisies, weeds}) {
    EXPECT_TRUE(kinds.contains(kind)) << static_cast<int>(kind);
  }
}

TEST(GroundDecals, LinesOfAPitchAreAsLongAsItsOutlineAtLeast) {
  world::Scenario scenario = open_ground();
  const auto lines_m = [&] {
    double sum_m = 0;
    for (const GroundDecal& decal : ground_decals(scenario)) {
      if (decal.kind == DecalKind::line) sum_m += 2 * decal.half_size.x();
    }
    return sum_m;
  };
  EXPECT_EQ(lines_m(), 0);
  world::Marking pitch;
  pitch.kind = "pitch";
  pitch.from = {-25, 0};
  pitch.to = {25, 0};
  pitch.width_m = 30;
  scenario.markings = {pitch};
  EXPECT_GT(lines_m(), 2 * (50 + 30));
}

TEST(GroundDecals, RepairsLieOnOneMaterialAndBelowNoProp) {
  const world::Scenario scenario = lively_place();
  const GroundMap map(scenario);
  for (const GroundDecal& decal : ground_decals(scenario)) {
    if (decal.kind > DecalKind::signs) continue;
    for (const Vector2d& corner :
         geometry::turned_rectangle(decal.middle, decal.half_size, decal.along)) {
      EXPECT_EQ(map.material_at(corner), map.material_at(decal.middle));
    }
    for (const world::Prop& prop : scenario.props) {
      if (prop.kind == world::PropKind::car) continue;
      EXPECT_GT(world::distance_to(prop, decal.middle), 0);
    }
  }
}

TEST(GroundDecals, AreFewOnLargeGround) {
  world::Scenario scenario = lively_place();
  scenario.ground = {{-400, -400}, {400, 400}};
  EXPECT_LE(ground_decals(scenario).size(), kMaxDecals);
}

TEST(GroundDecals, LeaveIdsClassesAndDepthAlone) {
  world::Scenario scenario = lively_place();
  scenario.props.clear();  // which drafts simplify
  const camera::Camera camera = camera_at({-6, -38, 14}, 90, -38, 640, 480);
  RenderOptions options = {.semantic = true};
  Stage with(scenario, {}, options);
  options.quality = Quality::draft;  // draws none
  Stage without(scenario, {}, options);
  const Frame worn = with.draw(camera);
  const Frame plain = without.draw(camera);
  EXPECT_EQ(worn.id, plain.id);
  // Drafts have larger triangles, which moves edges of layers by a few pixels.
  int others = 0;
  for (std::size_t i = 0; i < worn.id.size(); ++i) {
    others += worn.surface[i] != plain.surface[i] ? 1 : 0;
    ASSERT_NEAR(worn.depth_m[i], plain.depth_m[i], 0.002F * plain.depth_m[i]);
  }
  EXPECT_LT(others, 0.001 * static_cast<double>(worn.id.size()));
}

TEST(GroundDecals, Show) {
  world::Scenario scenario = lively_place();
  scenario.buildings.clear();
  scenario.props.clear();
  Stage stage(scenario);
  int seen = 0;
  for (const GroundDecal& decal : ground_decals(scenario)) {
    if (decal.kind != DecalKind::manhole || seen == 3) continue;
    ++seen;
    const camera::Camera camera =
        camera_at({decal.middle.x(), decal.middle.y(), 4}, 0, -90, 200, 200, 30);
    const Frame frame = stage.draw(camera);
    int cover = 0;
    int beside = 0;
    for (int i = -5; i <= 5; ++i) {
      cover += brightness(frame, 100 + i, 100);
      beside += brightness(frame, 100 + i, 5);
    }
    EXPECT_LT(cover, 0.8 * beside) << decal.middle.transpose();
  }
  EXPECT_GT(seen, 0);
}

TEST(GroundEdges, HaveLayersOfTheirOwn) {
  SceneryMesh mesh;
  std::set<std::string> materials;
  double highest_kerb_m = 0;
  double highest_other_m = 0;
  const auto layers = add_ground_layers(lively_place(), mesh);
  for (const GroundLayer& layer : layers) {
    materials.insert(layer.material);
    double& highest_m = layer.material == "kerb" ? highest_kerb_m : highest_other_m;
    for (std::uint32_t i = layer.range.first; i < layer.range.first + layer.range.count; ++i) {
      highest_m = std::max<double>(highest_m, mesh.vertices[mesh.indices[i]].position[2]);
    }
  }
  for (const char* material : {"asphalt", "grass", "kerb", "paint", "setts", "gutter", "tactile"}) {
    EXPECT_TRUE(materials.contains(material)) << material;
  }
  EXPECT_NEAR(highest_kerb_m, 0.05, 1e-6) << "around the lawn";
  EXPECT_LT(highest_other_m, 0.0018) << "below the decals";
}

TEST(GroundEdges, KerbsOfRoadsAreFlatAndEndWhereAsphaltGoesOn) {
  world::Scenario scenario = open_ground();
  scenario.areas.push_back({{{-40, -4}, {40, -4}, {40, 4}, {-40, 4}}, "asphalt", false});
  scenario.areas.push_back({{{-3, 4}, {3, 4}, {3, 40}, {-3, 40}}, "asphalt", false});
  double length_m = 0;
  for (const GroundSegment& edge : GroundMap(scenario).road_edges()) length_m += edge.length_m();
  EXPECT_NEAR(length_m, 80 + (80 - 6) + 2 * 36, 2) << "no kerb across the mouth of the side road";
  SceneryMesh mesh;
  add_ground_layers(scenario, mesh);
  for (const SceneryVertex& vertex : mesh.vertices) EXPECT_LT(vertex.position[2], 0.002F);
}

}  // namespace
}  // namespace throng::render
