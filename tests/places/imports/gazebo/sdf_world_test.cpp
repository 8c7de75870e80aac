// Gazebo's worlds: geometry, poses and inclusion, with places computed by hand.
#include "places/imports/gazebo/sdf_world.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "places/imports/gazebo/gazebo_colors.h"
#include "places/imports/sdf/local_files.h"
#include "places/imports/sdf/sdf_text.h"
#include "tests/world/temporary_folder.h"

namespace throng::imports {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using throng::testing::TemporaryFolder;

ImportedScenario read_world(const std::string& body) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "w.sdf",
                        "<sdf version='1.7'><world name='w'>" + body + "</world></sdf>");
  return read_sdf(folder.path() / "w.sdf", {});
}

/// A model of one link that is seen and felt alike.
std::string collision_text(const std::string& geometry, const std::string& pose = "0 0 0 0 0 0",
                           const std::string& material = "") {
  static int number = 0;
  const std::string shape = "<geometry>" + geometry + "</geometry>";
  return fmt::format(
      "<model name='m{}'><static>1</static><pose>{}</pose><link name='l'><visual name='v'>{}{}"
      "</visual><collision name='c'>{}</collision></link></model>",
      ++number, pose, shape, material, shape);
}

std::string box(double x, double y, double z) {
  return fmt::format("<box><size>{} {} {}</size></box>", x, y, z);
}

std::vector<std::string> reasons_in(const ImportedScenario& scenario) {
  std::vector<std::string> reasons;
  for (const Skipped& skipped : scenario.skipped) reasons.push_back(skipped.text());
  return reasons;
}

bool blocked(const ImportedScenario& scenario, const Vector2d& point) {
  return std::any_of(
      scenario.obstacles.begin(), scenario.obstacles.end(),
      [&](const Corners& corners) { return geometry::distance_to(corners, point) == 0; });
}

geometry::Rectangle building_bounds(const ImportedScenario& scenario) {
  EXPECT_EQ(scenario.buildings.size(), 1);
  return geometry::bounding_box(scenario.buildings.at(0).footprint);
}

/// Bounds of all that is drawn as it is, from low to high.
std::pair<Vector3d, Vector3d> seen_bounds(const ImportedScenario& scenario) {
  Vector3d low = Vector3d::Constant(1e9);
  Vector3d high = -low;
  for (const Object& object : scenario.objects) {
    for (const Solid& solid : object.solids) {
      for (const auto& triangle : solid.triangles) {
        for (const Vector3d& corner : triangle) {
          low = low.cwiseMin(corner);
          high = high.cwiseMax(corner);
        }
      }
    }
  }
  return {low, high};
}

void expect_seen(const ImportedScenario& scenario, const Vector3d& low, const Vector3d& high,
                 double within) {
  const auto [seen_low, seen_high] = seen_bounds(scenario);
  EXPECT_LT((seen_low - low).cwiseAbs().maxCoeff(), within) << seen_low.transpose();
  EXPECT_LT((seen_high - high).cwiseAbs().maxCoeff(), within) << seen_high.transpose();
}

TEST(SdfShapes, BoxesAndCylindersBecomeBuildings) {
  const ImportedScenario scenario = read_world(collision_text(box(4, 2, 3), "10 20 1.5 0 0 0"));
  const geometry::Rectangle bounds = building_bounds(scenario);
  EXPECT_LT((bounds.min - Vector2d(8, 19)).norm(), 1e-9);
  EXPECT_LT((bounds.max - Vector2d(12, 21)).norm(), 1e-9);
  EXPECT_NEAR(scenario.buildings[0].height_m, 3, 1e-9);
  EXPECT_TRUE(blocked(scenario, {10, 20}));
  const ImportedScenario silo = read_world(
      collision_text("<cylinder><radius>3</radius><length>8</length></cylinder>", "0 0 4 0 0 0"));
  EXPECT_NEAR(geometry::signed_area(silo.buildings.at(0).footprint),
              12 * 9 * std::sin(std::numbers::pi / 12), 1e-6);
  EXPECT_NEAR(silo.buildings[0].height_m, 8, 1e-9);
}

TEST(SdfShapes, OnlyTallOnesOnTheGroundBecomeBuildings) {
  EXPECT_EQ(read_world(collision_text(box(4, 4, 2.02), "0 0 1 0 0 0")).buildings.size(), 1);
  EXPECT_TRUE(read_world(collision_text(box(4, 4, 1.9), "0 0 0.95 0 0 0")).buildings.empty())
      << "low";
  EXPECT_EQ(read_world(collision_text(box(4, 4, 4), "0 0 2.4 0 0 0")).buildings.size(), 1)
      << "0.4 m off";
  const ImportedScenario high = read_world(collision_text(box(4, 4, 4), "0 0 2.6 0 0 0"));
  EXPECT_TRUE(high.buildings.empty()) << "0.6 m off the ground";
  EXPECT_TRUE(blocked(high, {0, 0})) << "but in the way";
  const ImportedScenario thin = read_world(collision_text(box(0.5, 0.5, 4), "0 0 2 0 0 0"));
  EXPECT_TRUE(thin.buildings.empty()) << "a post of 0.25 m^2";
  EXPECT_EQ(thin.objects.size(), 1);
}

TEST(SdfShapes, RoundOnesAreDrawnAsTheyAre) {
  expect_seen(read_world(collision_text("<sphere><radius>2</radius></sphere>", "5 0 2 0 0 0")),
              {3, -2, 0}, {7, 2, 4}, 0.05);
  expect_seen(read_world(collision_text("<capsule><radius>1</radius><length>4</length></capsule>",
                                        "0 5 3 0 0 0")),
              {-1, 4, 0}, {1, 6, 6}, 0.05);
  expect_seen(
      read_world(collision_text("<ellipsoid><radii>1 2 3</radii></ellipsoid>", "0 0 3 0 0 0")),
      {-1, -2, 0}, {1, 2, 6}, 0.05);
  expect_seen(read_world(collision_text("<cone><radius>1</radius><length>2</length></cone>",
                                        "0 0 1 0 0 0")),
              {-1, -1, 0}, {1, 1, 2}, 0.05);
}

TEST(SdfShapes, ACapsuleThatLiesTurnsItsAxis) {
  // Pitched by 90 degrees its axis is along x: half length 2 and radius 1.
  expect_seen(read_world(collision_text("<capsule><radius>1</radius><length>4</length></capsule>",
                                        "0 0 1 0 1.5707963 0")),
              {-3, -1, 0}, {3, 1, 2}, 0.05);
}

TEST(SdfShapes, APlaneIsGroundOfItsSizeAndColor) {
  const auto material = [](const char* rgb) {
    return fmt::format("<material><diffuse>{} 1</diffuse></material>", rgb);
  };
  const std::string plane = "<plane><normal>0 0 1</normal><size>{} {}</size></plane>";
  const auto ground = [&](const char* rgb) {
    const ImportedScenario scenario =
        read_world(collision_text(box(20, 20, 0.1), "0 0 0 0 0 0", material(rgb)));
    return scenario.areas.empty() ? std::string("none") : scenario.areas.at(0).material;
  };
  EXPECT_EQ(ground("0.2 0.5 0.2"), "grass");
  EXPECT_EQ(ground("0.5 0.4 0.2"), "dirt");
  EXPECT_EQ(ground("0.1 0.1 0.1"), "asphalt");
  EXPECT_EQ(ground("0.6 0.6 0.6"), "concrete");
  const ImportedScenario scenario =
      read_world(collision_text("<plane><normal>0 0 1</normal><size>6 10</size></plane>",
                                "3 4 0 0 0 0", material("0.2 0.5 0.2")) +
                 collision_text(box(4, 4, 4), "20 20 2 0 0 0"));
  ASSERT_EQ(scenario.areas.size(), 1);
  const geometry::Rectangle bounds = geometry::bounding_box(scenario.areas[0].corners);
  EXPECT_LT((bounds.min - Vector2d(0, -1)).norm(), 1e-9);
  EXPECT_LT((bounds.max - Vector2d(6, 9)).norm(), 1e-9);
  // The size is in the plane: turned with its normal, which the pose turns up again.
  for (const auto& [normal, pose] : {std::pair("0 1 0", "3 4 0 1.5707963267948966 0 0"),
                                     std::pair("1 0 0", "3 4 0 0 -1.5707963267948966 0"),
                                     std::pair("0 0 -1", "3 4 0 3.141592653589793 0 0"),
                                     std::pair("0 0 -1", "3 4 0 0 3.141592653589793 0")}) {
    const ImportedScenario turned = read_world(
        collision_text(fmt::format("<plane><normal>{}</normal><size>6 10</size></plane>", normal),
                       pose, material("0.2 0.5 0.2")) +
        collision_text(box(4, 4, 4), "20 20 2 0 0 0"));
    ASSERT_EQ(turned.areas.size(), 1) << normal << " at " << pose;
    const geometry::Rectangle shown = geometry::bounding_box(turned.areas[0].corners);
    EXPECT_LT((shown.min - Vector2d(0, -1)).norm(), 1e-6) << normal << " at " << pose;
    EXPECT_LT((shown.max - Vector2d(6, 9)).norm(), 1e-6) << normal << " at " << pose;
  }
  const ImportedScenario tilted = read_world(
      collision_text("<plane><normal>0 1 1</normal><size>6 10</size></plane>", "0 0 0 0 0 0"));
  EXPECT_THAT(reasons_in(tilted), ::testing::Contains(HasSubstr("a plane that is not level")));
}

TEST(SdfShapes, FlatBodiesLieOnEachOtherByHeight) {
  const std::string green = "<material><diffuse>0.2 0.5 0.2 1</diffuse></material>";
  const ImportedScenario scenario =
      read_world(collision_text(box(4, 4, 0.1), "0 0 0.1 0 0 0") +
                 collision_text(box(20, 20, 0.1), "0 0 0 0 0 0", green));
  ASSERT_EQ(scenario.areas.size(), 2);
  EXPECT_EQ(scenario.areas[0].material, "grass") << "the lower one first";
  EXPECT_EQ(scenario.areas[1].material, "concrete");
  EXPECT_FALSE(blocked(scenario, {0, 0}));
}

TEST(SdfShapes, PolylinesHaveHoles) {
  const std::string hall =
      "<polyline><point>0 0</point><point>20 0</point><point>20 20</point><point>0 20</point>"
      "<height>4</height></polyline><polyline><point>5 5</point><point>15 5</point>"
      "<point>15 15</point><point>5 15</point><height>4</height></polyline>";
  const ImportedScenario scenario = read_world(collision_text(hall, "0 0 0 0 0 0"));
  const auto [low, high] = seen_bounds(scenario);
  EXPECT_NEAR(high.z(), 4, 1e-9);
  for (const double x : {0.0, 5.0, 15.0, 20.0}) EXPECT_TRUE(blocked(scenario, {x, 10})) << x;
  EXPECT_FALSE(blocked(scenario, {10, 10})) << "the courtyard";
  EXPECT_THAT(reasons_in(read_world(collision_text(
                  "<polyline><point>0 0</point><point>1 1</point><height>3</height></polyline>"))),
              ::testing::Contains(HasSubstr("a polyline without an area")));
}

TEST(SdfShapes, MeshesAreScaledAndPlaced) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "m.obj",
                        "o a\nv 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\no b\nv 0 0 5\nv 1 0 5\nv 0 1 6\n"
                        "f 4 5 6\n");
  const auto read = [&](const std::string& more, const std::string& uri = "m.obj") {
    write_file_atomically(folder.path() / "w.sdf",
                          "<sdf version='1.7'><world name='w'>" +
                              collision_text("<mesh><uri>" + uri + "</uri>" + more + "</mesh>",
                                             "10 0 0 0 0 1.5707963") +
                              "</world></sdf>");
    return read_sdf(folder.path() / "w.sdf", {});
  };
  // x to y and y to -x.
  expect_seen(read("<scale>2 3 0.5</scale>"), {7, 0, 0}, {10, 2, 3}, 1e-5);
  expect_seen(read("<submesh><name>a</name></submesh>"), {9, 0, 0}, {10, 1, 1}, 1e-5);
  EXPECT_THAT(reasons_in(read("", "gone.obj")),
              ::testing::Contains(HasSubstr("mesh \"gone.obj\", not a file in the folders")));
  EXPECT_THAT(reasons_in(read("<scale>1e6 1 1</scale>")),
              ::testing::Contains(HasSubstr("a scale")));
}

TEST(SdfShapes, OthersAreNamed) {
  EXPECT_THAT(reasons_in(read_world(
                  collision_text("<heightmap><uri>h.png</uri><size>9 9 1</size></heightmap>"))),
              ::testing::Contains(HasSubstr("<heightmap>, not a box, cylinder")));
  EXPECT_TRUE(reasons_in(read_world(collision_text("<empty/>"))).empty());
  EXPECT_THAT(reasons_in(read_world(collision_text(box(20000, 1, 1)))),
              ::testing::Contains(HasSubstr("a size of 20000 m, not a size above 0")));
}

TEST(SdfPoses, AddUpFromWorldToVisual) {
  // World: model at (10, 0) turned by 90 degrees; link 5 m ahead of it, that is at (10, 5), turned
  // by 90 more; visual 2 m ahead of that: along -x, at (8, 5). A box of 4 x 2 keeps 4 m along x.
  const ImportedScenario scenario = read_world(
      "<model name='m'><pose>10 0 0 0 0 1.5707963</pose><link name='l'>"
      "<pose>5 0 0 0 0 1.5707963</pose><visual name='v'><pose>2 0 1.5 0 0 0</pose><geometry>" +
      box(4, 2, 3) + "</geometry></visual></link></model>");
  const geometry::Rectangle bounds = building_bounds(scenario);
  EXPECT_LT((bounds.min - Vector2d(6, 4)).norm(), 1e-5);
  EXPECT_LT((bounds.max - Vector2d(10, 6)).norm(), 1e-5);
}

TEST(SdfPoses, NestedModelsMoveWithTheirParents) {
  const ImportedScenario scenario = read_world(
      "<model name='a'><pose>10 10 0 0 0 3.14159265</pose><link name='x'/><model name='b'>"
      "<pose>3 1 2 0 0 0</pose><link name='l'><visual name='v'><geometry>" +
      box(2, 2, 4) + "</geometry></visual></link></model></model>");
  const geometry::Rectangle bounds = building_bounds(scenario);
  EXPECT_LT((0.5 * (bounds.min + bounds.max) - Vector2d(7, 9)).norm(), 1e-5);
}

TEST(SdfPoses, MayBeRelativeToFramesAndInDegrees) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "w.sdf",
                        "<sdf version='1.9'><world name='w'><frame name='f'><pose degrees='true'>"
                        "10 0 0 0 0 90</pose></frame><model name='m'><pose relative_to='f'>5 1 2 0 "
                        "0 0</pose><link name='l'><visual name='v'><geometry>" +
                            box(2, 4, 4) + "</geometry></visual></link></model></world></sdf>");
  const geometry::Rectangle bounds = building_bounds(read_sdf(folder.path() / "w.sdf", {}));
  // 5 m along the frame's x (world y) and 1 m along its y (world -x).
  EXPECT_LT((0.5 * (bounds.min + bounds.max) - Vector2d(9, 5)).norm(), 1e-5);
  EXPECT_NEAR(bounds.max.x() - bounds.min.x(), 4, 1e-5) << "turned by 90 degrees";
}

TEST(SdfPoses, FarAwayAndUnknownOnesAreSkipped) {
  const ImportedScenario far = read_world(collision_text(box(4, 4, 4), "6000 0 2 0 0 0"));
  EXPECT_THAT(reasons_in(far), ::testing::Contains(HasSubstr("more than 5 km away")));
  EXPECT_TRUE(far.buildings.empty());
}

TEST(SdfBuildings, AreCutWhereTheyOverlap) {
  const ImportedScenario scenario = read_world(collision_text(box(10, 10, 4), "0 0 2 0 0 0") +
                                               collision_text(box(10, 10, 6), "5 0 3 0 0 0"));
  double total = 0;
  for (const world::Building& building : scenario.buildings) {
    total += geometry::signed_area(building.footprint);
  }
  EXPECT_NEAR(total, 150, 1e-6);
}

TEST(SdfVisuals, AreSeenAndCollisionsAreInTheWay) {
  const ImportedScenario ghost =
      read_world("<model name='g'><link name='l'><visual name='v'><geometry>" + box(4, 4, 1) +
                 "</geometry></visual><collision name='c'><pose>20 0 0 0 0 0</pose><geometry>" +
                 box(2, 2, 1) + "</geometry></collision></link></model>");
  EXPECT_FALSE(blocked(ghost, {0, 0})) << "seen only";
  EXPECT_TRUE(blocked(ghost, {20, 0})) << "felt only";
  const ImportedScenario seen =
      read_world("<model name='s'><link name='l'><visual name='v'><geometry>" + box(4, 4, 1) +
                 "</geometry></visual></link></model>");
  EXPECT_TRUE(blocked(seen, {0, 0})) << "a link without collisions is felt as it is seen";
}

TEST(SdfLights, BecomeLampPostsOfTheirHeight) {
  const ImportedScenario scenario = read_world(
      "<light name='a' type='point'><pose>3 4 9.2 0 0 0</pose></light>"
      "<light name='b' type='spot'><pose>5 4 1 0 0 0</pose></light>"
      "<light name='c' type='point'><pose>5 4 13 0 0 0</pose></light>"
      "<model name='m'><pose>10 0 0 0 0 0</pose><link name='l'><light name='d' type='point'>"
      "<pose>0 2 4.6 0 0 0</pose></light></link></model>");
  ASSERT_EQ(scenario.props.size(), 2);
  EXPECT_EQ(scenario.props[1].kind, world::PropKind::lamp_post);
  const auto at = [&](const Vector2d& p) {
    return std::find_if(scenario.props.begin(), scenario.props.end(),
                        [&](const world::Prop& prop) { return (prop.position - p).norm() < 1e-9; });
  };
  ASSERT_NE(at({3, 4}), scenario.props.end());
  EXPECT_NEAR(at({3, 4})->scale, 2, 1e-9) << "9.2 m of 4.6 m";
  ASSERT_NE(at({10, 2}), scenario.props.end());
  EXPECT_NEAR(at({10, 2})->scale, 1, 1e-9);
  EXPECT_THAT(reasons_in(scenario),
              ::testing::Contains(HasSubstr("world/b: only lamps 2 to 12 m")));
}

TEST(SdfModels, MayStandAlone) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "Tower 2.sdf",
                        "<sdf version='1.7'><model name='m'><link name='l'><visual name='v'>"
                        "<geometry>" +
                            box(4, 4, 8) + "</geometry></visual></link></model></sdf>");
  const ImportedScenario scenario = read_sdf(folder.path() / "Tower 2.sdf", {});
  EXPECT_EQ(scenario.name, "tower_2");
  EXPECT_EQ(scenario.buildings.size(), 1);
}

TEST(SdfModels, AreIncludedFromFoldersWithTheirPoses) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "extra/hut/model.config",
                        "<model><name>hut</name><sdf version='1.7'>model.sdf</sdf></model>");
  write_file_atomically(folder.path() / "extra/hut/model.sdf",
                        "<sdf version='1.7'><model name='hut'><pose>1 0 0 0 0 0</pose>"
                        "<link name='l'><visual name='v'><geometry>" +
                            box(2, 2, 6) + "</geometry></visual></link></model></sdf>");
  write_file_atomically(folder.path() / "worlds/w.sdf",
                        "<sdf version='1.7'><world name='w'><include><uri>model://hut</uri>"
                        "<name>one</name><pose>10 0 0 0 0 0</pose></include><include>"
                        "<uri>model://hut</uri><name>two</name><pose>30 0 0 0 0 0</pose></include>"
                        "</world></sdf>");
  const ImportedScenario without = read_sdf(folder.path() / "worlds/w.sdf", {});
  EXPECT_TRUE(without.buildings.empty());
  EXPECT_THAT(reasons_in(without), ::testing::Contains(HasSubstr("--models")));
  const ImportedScenario scenario =
      read_sdf(folder.path() / "worlds/w.sdf", {{folder.path() / "extra"}, {}});
  ASSERT_EQ(scenario.buildings.size(), 2);
  EXPECT_EQ(geometry::distance_to(scenario.buildings[0].footprint, {10, 0}), 0)
      << "the pose of <include> replaces the model's";
  EXPECT_EQ(geometry::distance_to(scenario.buildings[1].footprint, {30, 0}), 0);
}

TEST(SdfSkipped, NamesActorsJointsAndSecondWorlds) {
  const ImportedScenario scenario = read_world(
      "<actor name='walker'><pose>0 0 0 0 0 0</pose></actor><model name='m'><link name='a'/>"
      "<link name='b'/><joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>"
      "<plugin name='p' filename='p.so'/></model><model name='hollow'/>");
  const auto reasons = reasons_in(scenario);
  EXPECT_THAT(reasons, ::testing::Contains(HasSubstr("actor walker: a person begins")));
  EXPECT_THAT(reasons, ::testing::Contains(HasSubstr("m <joint>: has no meaning")));
  EXPECT_THAT(reasons, ::testing::Contains(HasSubstr("m <plugin>: has no meaning")));
}

TEST(SdfScenarios, ReachAsFarAsTheirObjects) {
  const ImportedScenario scenario = read_world(collision_text(box(4, 4, 3), "-20 -10 1.5 0 0 0") +
                                               collision_text(box(4, 4, 3), "20 10 1.5 0 0 0"));
  EXPECT_LT((scenario.inside.min - Vector2d(-22, -12)).norm(), 1e-9);
  EXPECT_LT((scenario.inside.max - Vector2d(22, 12)).norm(), 1e-9);
  const ImportedScenario small = read_world(collision_text(box(4, 4, 3), "0 0 1.5 0 0 0"));
  EXPECT_LT((small.inside.min - Vector2d(-10, -10)).norm(), 1e-9) << "8 m of ground around it";
  EXPECT_THROW(read_world(collision_text(box(4, 4, 3), "-2000 0 1.5 0 0 0") +
                          collision_text(box(4, 4, 3), "2000 0 1.5 0 0 0")),
               InputError);
}

TEST(GazeboColors, AreThoseOfItsMaterialScript) {
  EXPECT_EQ(gazebo_color("Gazebo/Red"), Vector3d(1, 0, 0));
  EXPECT_EQ(gazebo_color("Gazebo/RedTransparent"), Vector3d(1, 0, 0));
  EXPECT_EQ(gazebo_color("file://x/Gazebo/Blue"), Vector3d(0, 0, 1));
  EXPECT_EQ(gazebo_color("Gazebo/DarkGrey"), Vector3d(0.18, 0.18, 0.18)) << "not Grey";
  EXPECT_EQ(gazebo_color("Gazebo/FlatBlack"), Vector3d(0.1, 0.1, 0.1)) << "not Black";
  EXPECT_EQ(gazebo_color("Gazebo/SkyBlue"), Vector3d(0.13, 0.44, 0.7)) << "not Blue";
  EXPECT_FALSE(gazebo_color("Gazebo/Unheard"));
  EXPECT_FALSE(gazebo_color("Red"));
  EXPECT_FALSE(gazebo_color(""));
}

TEST(LocalFilesTest, FindsByUriBelowItsFolders) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "a/m/x.obj", "a");
  write_file_atomically(folder.path() / "b/m/x.obj", "b");
  write_file_atomically(folder.path() / "b/m/y.obj", "b");
  write_file_atomically(folder.path() / "secret.obj", "s");
  const LocalFiles files({folder.path() / "a", folder.path() / "b", folder.path() / "missing"});
  const auto found = [&](const std::string& uri, const std::filesystem::path& from = {}) {
    const auto path = files.find(uri, from);
    return path ? read_file(*path) : std::string("-");
  };
  EXPECT_EQ(found("model://m/x.obj"), "a") << "the first folder first";
  EXPECT_EQ(found("model://m/y.obj"), "b");
  EXPECT_EQ(found("package://m/y.obj"), "b");
  EXPECT_EQ(found("m/x.obj"), "a");
  EXPECT_EQ(found("x.obj", folder.path() / "b/m/w.sdf"), "b") << "beside the file that asks";
  EXPECT_EQ(found("file://" + (folder.path() / "b/m/x.obj").string()), "b");
  EXPECT_EQ(found("file://" + (folder.path() / "secret.obj").string()), "-");
  EXPECT_EQ(found("../secret.obj"), "-");
  EXPECT_EQ(found("model://../secret.obj"), "-");
  EXPECT_EQ(found("https://example.org/m/x.obj"), "-");
  EXPECT_EQ(found(""), "-");
  EXPECT_EQ(found("model://"), "-");
  std::filesystem::create_symlink(folder.path() / "secret.obj", folder.path() / "a/link.obj");
  EXPECT_EQ(found("model://link.obj"), "-") << "a link out of the folder";
}

TEST(SdfTextTest, TakesOutTheSmallestPart) {
  SdfText text("w.sdf",
               "<?xml version='1.0'?>\n<sdf version='1.7'>\n<!-- a\ncomment -->\n"
               "<world name='w'><model name='a'>\n<link name='b'>\n<visual name='c'><pose>x</pose>"
               "</visual>\n<visual name='d'/></link></model></world></sdf>");
  // Elements in order: sdf, world, model, link, visual c, pose, visual d; lines from 2 on.
  EXPECT_EQ(text.line_of(2), 2);
  EXPECT_EQ(text.line_of(3), 5);
  EXPECT_EQ(text.line_of(5), 6);
  EXPECT_EQ(text.line_of(7), 7);
  const auto part = text.take_out(7);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->name, "model a/link b/visual c");
  EXPECT_EQ(part->line, 7);
  EXPECT_THAT(text.text(), ::testing::Not(HasSubstr("<pose>")));
  EXPECT_THAT(text.text(), HasSubstr("<visual name='d'/>"));
  EXPECT_EQ(text.line_of(8), 8) << "the rest did not move";
  EXPECT_FALSE(text.take_out(2)) << "the root";
  EXPECT_FALSE(text.take_out(99));
  EXPECT_FALSE(text.take_out(0));
}

TEST(SdfTextTest, RefusesOtherXml) {
  const auto error_of = [](const std::string& text) {
    try {
      SdfText("w.sdf", text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(error_of("<gazebo/>"),
              ::testing::AllOf(HasSubstr("w.sdf"), HasSubstr("<gazebo>"), HasSubstr("gz sdf")));
  EXPECT_THAT(error_of("<sdf>\n<world>\n</sdf>"), HasSubstr("line"));
  EXPECT_THAT(error_of(""), HasSubstr("w.sdf"));
  EXPECT_EQ(error_of("<sdf a='>'><![CDATA[<x>]]></sdf>"), "accepted");
}

}  // namespace
}  // namespace throng::imports
