// Rubble of a collapse, and walls too low to be houses.
#include "render/scenery/rubble.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/buildings/roof_details.h"
#include "render/scenery/lamps.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

world::Disaster falling_wall() { return {world::DisasterKind::collapse, 0, {14, 0}, 5, 2, 1, 6}; }

TEST(Rubble, LiesWhereTheCollapseHasReached) {
  const std::vector<RubblePiece> pieces = make_rubble(falling_wall(), kIdProp);
  ASSERT_GT(pieces.size(), 50U);
  for (const RubblePiece& piece : pieces) {
    EXPECT_GE(piece.from_s, 5);
    EXPECT_LE(piece.from_s, 9 + 1e-9) << "4 m at 1 m/s";
    for (const PropVertex& vertex : piece.mesh.vertices) {
      const Eigen::Vector2d at(vertex.position[0], vertex.position[1]);
      EXPECT_LT((at - falling_wall().position).norm(), 6 + 2);
      EXPECT_GE(vertex.position[2], 0);
    }
  }
  world::Disaster fire = falling_wall();
  fire.kind = world::DisasterKind::fire;
  EXPECT_TRUE(make_rubble(fire, kIdProp).empty());
}

TEST(Rubble, IsInTheImageAndItsIdsOnceItHasFallen) {
  world::Scenario scenario = open_ground();
  scenario.disasters = {falling_wall()};
  Stage stage(scenario);
  const camera::Camera camera = camera_at({0, 0, 8}, 0, -28);
  const auto pixels_at = [&](double time_s) {
    Scene scene;
    scene.time_s = time_s;
    return instance_mask(stage.renderer().draw(scene, camera), kIdProp).pixels;
  };
  EXPECT_EQ(pixels_at(4.9), 0U);
  const std::uint64_t first = pixels_at(5.1);
  EXPECT_GT(first, 200U);
  EXPECT_GT(pixels_at(9.1), first + 200);
}

TEST(Rubble, IsNearerThanTheGroundBehindItAndHidesIt) {
  world::Scenario scenario = open_ground();
  scenario.disasters = {falling_wall()};
  Stage stage(scenario);
  const camera::Camera camera = camera_at({0, 0, 8}, 0, -28);
  Scene scene;
  scene.time_s = 4.9;
  const Frame before = stage.renderer().draw(scene, camera);
  scene.time_s = 9.1;
  const Frame after = stage.renderer().draw(scene, camera);
  std::size_t rubble = 0;
  std::size_t nearer = 0;
  for (std::size_t i = 0; i < after.id.size(); ++i) {
    if (after.id[i] != kIdProp) {
      EXPECT_EQ(after.depth_m[i], before.depth_m[i]) << "nothing else has changed";
      EXPECT_EQ(after.id[i], before.id[i]);
      continue;
    }
    ++rubble;
    if (after.depth_m[i] < before.depth_m[i] - 0.05F) ++nearer;
    EXPECT_LE(after.depth_m[i], before.depth_m[i] + 1e-3F);
  }
  EXPECT_GT(rubble, 400U);
  EXPECT_GT(nearer, rubble / 2) << "it stands up from the ground";
}

TEST(Rubble, OfTwoCollapsesHasAnIdEachAfterThoseOfTheProps) {
  world::Scenario scenario = open_ground();
  scenario.props = {{}};
  scenario.props[0].position = {-30, -30};
  scenario.placed_props = 1;
  scenario.disasters = {falling_wall(), falling_wall()};
  scenario.disasters[1].position = {14, 14};
  scenario.disasters[1].agent = 1;
  Stage stage(scenario);
  Scene scene;
  scene.time_s = 20;
  const Frame frame = stage.renderer().draw(scene, camera_at({-6, 7, 14}, 0, -30));
  const Mask right = instance_mask(frame, kIdProp + 1);
  const Mask left = instance_mask(frame, kIdProp + 2);
  ASSERT_GT(right.pixels, 200U);
  ASSERT_GT(left.pixels, 200U);
  EXPECT_GT(right.box.center().x(), left.box.center().x()) << "which is farther to the left";
}

TEST(LowWalls, HaveNeitherLampsNorMachinesOnTop) {
  for (const auto& [height_m, is_house] : {std::pair(0.1, false), {1.4, false}, {5.0, true}}) {
    const world::Scenario scenario = open_ground({block(5, 25, -10, 10, height_m)});
    world::Building building = scenario.buildings[0];
    building.facade = world::Facade::by_id;
    const BuildingModel model = building_model(building, 0);
    EXPECT_EQ(roof_details(model, 1).vertices.empty(), !is_house) << height_m;
    EXPECT_EQ(wall_lamps(scenario).empty(), !is_house) << height_m;
  }
}

}  // namespace
}  // namespace throng::render
