// Doors where exits are in walls, and what stands on roofs.
#include "render/buildings/exit_doors.h"

#include <gtest/gtest.h>

#include <set>

#include "render/buildings/building_mesh.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

world::Exit exit_in(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool open = true) {
  world::Exit exit;
  exit.id = "exit";
  exit.from = from;
  exit.to = to;
  exit.open = open;
  return exit;
}

/// A wall at x = 8 that faces the origin.
world::Scenario wall_with(std::vector<world::Exit> exits) {
  world::Scenario scenario = open_ground({block(8, 13, -6, 6, 5)});
  scenario.exits = std::move(exits);
  return scenario;
}

/// Corners of walls with this look.
std::vector<SceneryVertex> rectangle_corners(const world::Scenario& scenario, WallLook look) {
  std::vector<SceneryVertex> corners;
  for (const SceneryVertex& vertex : scenery_mesh(scenario).vertices) {
    if (vertex.facade == static_cast<float>(look)) corners.push_back(vertex);
  }
  return corners;
}

TEST(ExitDoors, AreAsWideAsTheExitWhereItsWallIs) {
  const std::vector<SceneryVertex> corners =
      rectangle_corners(wall_with({exit_in({8, 1}, {8, 3})}), WallLook::open_door);
  ASSERT_EQ(corners.size(), 4U);
  Eigen::AlignedBox3d box;
  for (const SceneryVertex& corner : corners) {
    box.extend(Eigen::Map<const Eigen::Vector3f>(corner.position.data()).cast<double>());
    EXPECT_EQ(corner.id, kIdBuilding);
    EXPECT_NEAR(corner.normal[0], -1, 1e-6) << "to the square";
  }
  EXPECT_NEAR(box.min().x(), 7.97, 1e-6);
  EXPECT_NEAR(box.min().y(), 1, 1e-6);
  EXPECT_NEAR(box.max().y(), 3, 1e-6);
  EXPECT_NEAR(box.max().z(), 2.5, 1e-6);
}

TEST(ExitDoors, GapsBetweenBuildingsHaveNone) {
  for (const world::Exit& exit : {exit_in({8, 6}, {8, 9}), exit_in({0, 1}, {0, 3}),
                                  exit_in({8, 1}, {10, 1}), exit_in({6.5, 1}, {6.5, 3})}) {
    EXPECT_TRUE(rectangle_corners(wall_with({exit}), WallLook::open_door).empty())
        << exit.from.transpose() << " to " << exit.to.transpose();
  }
}

TEST(ExitDoors, ShowAnOpeningAndHideNothingElse) {
  const camera::Camera camera = camera_at({0, 0, 2}, 0, 0, 480, 320);
  const auto frame_of = [&](const world::Scenario& scenario) {
    return Stage(scenario).draw(camera);
  };
  const Frame bare = frame_of(wall_with({}));
  const Frame open = frame_of(wall_with({exit_in({8, 1}, {8, 3})}));
  const Frame closed = frame_of(wall_with({exit_in({8, 1}, {8, 3}, false)}));
  EXPECT_EQ(bare.id, open.id);
  EXPECT_NE(open.rgb, closed.rgb);
  const auto middle = [&](const Frame& frame, double y) {
    const Eigen::Vector2d pixel = camera.project({8, y, 1.6}).pixel;
    return brightness(frame, static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  };
  EXPECT_LT(middle(open, 2), 200) << "a dark passage";
  EXPECT_EQ(middle(open, -3), middle(bare, -3));
}

}  // namespace
}  // namespace throng::render
