// Populations, roads and actors of Gazebo's worlds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "places/imports/parts/populate.h"
#include "tests/places/imports/gazebo/world_text.h"

namespace throng::imports {
namespace {

using Eigen::Vector2d;
using imports_testing::box_model;
using imports_testing::building_at;
using imports_testing::is_listed;
using imports_testing::read_world_text;

std::string population(const std::string& region, int count, const std::string& distribution) {
  return "<population name='p'>" + box_model("crate", 1, 1, 3) + region +
         fmt::format("<model_count>{}</model_count><distribution>{}</distribution></population>",
                     count, distribution);
}

const std::string kBox = "<pose>20 10 0 0 0 0</pose><box><size>30 20 1</size></box>";

TEST(Populations, AtRandomStandInTheirRegion) {
  const std::string text = population(kBox, 12, "<type>random</type>");
  const ImportedScenario scenario = read_world_text(text, "1.7");
  ASSERT_GE(scenario.buildings.size(), 12);
  for (const world::Building& building : scenario.buildings) {
    for (const Vector2d& corner : building.footprint) {
      EXPECT_LE(std::abs(corner.x() - 20), 15.5);
      EXPECT_LE(std::abs(corner.y() - 10), 10.5);
    }
  }
  const ImportedScenario again = read_world_text(text, "1.7");
  EXPECT_EQ(again.buildings.at(3).footprint, scenario.buildings.at(3).footprint);
  EXPECT_TRUE(scenario.skipped.empty());
}

TEST(Populations, StandOnGridsAndLines) {
  const ImportedScenario grid = read_world_text(
      population(kBox, 1, "<type>grid</type><rows>2</rows><cols>3</cols><step>4 6 0</step>"),
      "1.7");
  EXPECT_EQ(grid.buildings.size(), 6);
  for (const double x : {16.0, 20.0, 24.0}) {
    for (const double y : {7.0, 13.0}) EXPECT_NE(building_at(grid, {x, y}), nullptr) << x << y;
  }
  const ImportedScenario line =
      read_world_text(population(kBox, 3, "<type>linear-x</type>"), "1.7");
  for (const double x : {10.0, 20.0, 30.0}) EXPECT_NE(building_at(line, {x, 10}), nullptr) << x;
  const ImportedScenario even = read_world_text(population(kBox, 6, "<type>uniform</type>"), "1.7");
  EXPECT_EQ(even.buildings.size(), 6);
}

TEST(Populations, OfOldWorldsHaveRegionsOfTheirOwn) {
  const ImportedScenario scenario = read_world_text(
      "<population name='p'><model name='huts'><include><uri>model://hut</uri></include></model>"
      "<region><cuboid><min>10 10 0</min><max>40 30 1</max></cuboid></region>"
      "<model_count>2</model_count><distribution>linear-x</distribution></population>"
      "<population name='q'>" +
          box_model("crate", 1, 1, 3) +
          "<region><cylinder><center>-20 -20 0</center><radius>5</radius><height>1</height>"
          "</cylinder></region><model_count>5</model_count><distribution>uniform</distribution>"
          "</population>",
      "1.5");
  EXPECT_NE(building_at(scenario, {17.5, 20}), nullptr);
  EXPECT_NE(building_at(scenario, {32.5, 20}), nullptr);
  EXPECT_EQ(std::count_if(scenario.buildings.begin(), scenario.buildings.end(),
                          [](const world::Building& building) {
                            return (building.footprint[0] - Vector2d(-20, -20)).norm() < 6;
                          }),
            5);
}

TEST(Populations, ThatCannotBePlacedAreListed) {
  const ImportedScenario scenario =
      read_world_text(population(kBox, 2, "<type>spiral</type>"), "1.7");
  EXPECT_TRUE(scenario.buildings.empty());
  EXPECT_TRUE(is_listed(scenario, "w.world:3: population p: its distribution is \"spiral\""));
}

TEST(Roads, AreGroundOfAsphalt) {
  const ImportedScenario scenario = read_world_text(
      "<road name='r'><width>6</width><point>0 0 0</point><point>80 0 0</point></road>"
      "<road name='ramp'><width>6</width><point>0 0 0</point><point>80 0 9</point></road>"
      "<road name='dot'><width>6</width><point>1 1 0</point></road>");
  ASSERT_EQ(scenario.areas.size(), 1);
  EXPECT_EQ(scenario.areas[0].material, "asphalt");
  EXPECT_EQ(geometry::distance_to(scenario.areas[0].corners, {79, 2.9}), 0);
  EXPECT_GT(geometry::distance_to(scenario.areas[0].corners, {79, 3.1}), 0);
  EXPECT_TRUE(scenario.inside.contains(Vector2d(79, 0))) << "the world reaches as far";
  EXPECT_TRUE(is_listed(scenario, "road ramp: leads 9.0 m above or below the ground"));
  EXPECT_TRUE(is_listed(scenario, "road dot: fewer than two points"));
}

TEST(Actors, BecomePeopleWhereTheirScriptsBegin) {
  ImportedScenario scenario = read_world_text(
      box_model("a", 4, 4, 3) +
      "<actor name='walker'><pose>9 9 0 0 0 0</pose><script><trajectory id='0' type='walk'>"
      "<waypoint><time>0</time><pose>8 -3 0 0 0 0</pose></waypoint></trajectory></script></actor>"
      "<actor name='stander'><pose>-10 6 0 0 0 0</pose></actor>"
      "<actor name='inside'><pose>0 0 0 0 0 0</pose></actor>");
  EXPECT_TRUE(is_listed(scenario, "actor walker: a person begins at [8.0, -3.0]"));
  const Population population = populate(scenario, {30, 1});
  ASSERT_EQ(population.starts.size(), 30);
  EXPECT_EQ(population.starts[0], Vector2d(8, -3));
  EXPECT_EQ(population.starts[1], Vector2d(-10, 6));
  EXPECT_TRUE(is_listed(scenario, "person at [0.0, 0.0]: stands where nobody can"));
}

}  // namespace
}  // namespace throng::imports
