// OpenStreetMap: buildings, streets, barriers and gates of a small map drawn by hand.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/resources.h"
#include "base/geometry/polygon.h"
#include "places/imports/osm/osm_map.h"
#include "places/imports/osm/osm_tags.h"
#include "tests/places/imports/drawn_map.h"
#include "tests/world/temporary_folder.h"

namespace throng::imports {
namespace {

using imports_testing::DrawnMap;
using imports_testing::height_at;
using imports_testing::stops_people;

const std::filesystem::path kMaps = source_folder() / "tests/places/imports/data";

class Quarter : public ::testing::Test {
 protected:
  static bool covers(const Corners& corners, const Eigen::Vector2d& point) {
    return geometry::distance_to(corners, point) == 0;
  }
  bool built(const Eigen::Vector2d& point) const {
    return std::any_of(
        scenario.buildings.begin(), scenario.buildings.end(),
        [&](const world::Building& building) { return covers(building.footprint, point); });
  }
  bool blocked(const Eigen::Vector2d& point) const {
    return std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(),
                       [&](const Corners& obstacle) { return covers(obstacle, point); });
  }
  /// Meters from the south-western corner's degrees.
  static Eigen::Vector2d at(double latitude, double longitude) {
    constexpr double kNorth = 111'229.0;  // of a degree at 50 degrees on WGS 84
    constexpr double kEast = 71'696.0;
    return {kEast * (longitude - 10), kNorth * (latitude - 50)};
  }
  bool mentions(const std::string& words) const {
    return std::any_of(scenario.skipped.begin(), scenario.skipped.end(), [&](const Skipped& one) {
      return one.text().find(words) != std::string::npos;
    });
  }

  ImportedScenario scenario = read_osm(kMaps / "quarter.osm", {GeoPoint{50, 10}, {}});
};

TEST_F(Quarter, IsProjectedToMeters) {
  EXPECT_NEAR(scenario.inside.min.norm(), 0, 1e-6);
  EXPECT_NEAR(scenario.inside.max.x(), at(0, 10.0014).x(), 0.1);
  EXPECT_NEAR(scenario.inside.max.y(), at(50.0009, 0).y(), 0.1);
}

TEST_F(Quarter, HasBuildingsWithCourtyardsAndHeights) {
  EXPECT_TRUE(built(at(50.00055, 10.0003)));
  EXPECT_FALSE(built(at(50.00065, 10.0003)));  // the courtyard
  for (const world::Building& building : scenario.buildings) {
    EXPECT_TRUE(geometry::is_simple(building.footprint));
    if (covers(building.footprint, at(50.00055, 10.0003))) {
      EXPECT_NEAR(building.height_m, 12, 1e-9);
    }
    if (covers(building.footprint, at(50.00057, 10.0009))) {
      EXPECT_NEAR(building.height_m, 21.5, 1e-9);
    }
  }
  EXPECT_TRUE(mentions("way 4"));   // overlaps way 3
  EXPECT_FALSE(mentions("way 5"));  // crosses itself
  EXPECT_FALSE(built(at(50.00015, 10.0002)));
  EXPECT_FALSE(blocked(at(50.00015, 10.0002)));  // on stilts
}

TEST_F(Quarter, HasWaysBarriersAndWater) {
  EXPECT_TRUE(
      std::any_of(scenario.areas.begin(), scenario.areas.end(), [&](const world::GroundArea& a) {
        return a.material == "asphalt" && covers(a.corners, at(50.00035, 10.001));
      }));
  const auto crossing = std::find_if(scenario.markings.begin(), scenario.markings.end(),
                                     [](const world::Marking& m) { return m.kind == "crossing"; });
  ASSERT_NE(crossing, scenario.markings.end());
  EXPECT_NEAR((crossing->to - crossing->from).norm(), 0.94 * 6, 0.1);
  EXPECT_TRUE(blocked(at(50.00028, 10.00074)));
  EXPECT_FALSE(blocked(at(50.00028, 10.00085)));  // the gate in the fence
  EXPECT_TRUE(blocked(at(50.000095, 10.00078)));  // the pond
  EXPECT_TRUE(mentions("railway=tram"));
  EXPECT_EQ(std::count_if(scenario.props.begin(), scenario.props.end(),
                          [](const world::Prop& p) { return p.kind == world::PropKind::tree; }),
            3);
}

TEST_F(Quarter, IsLeftWhereItsWaysLeaveIt) {
  ASSERT_EQ(scenario.gates.size(), 4U);  // the street and the footway, twice each
  for (const Gate& gate : scenario.gates) {
    const double width = (gate.to - gate.from).norm();
    EXPECT_NEAR(gate.share, width < 4 ? 3 : 0.3 * 6, 1e-6);
  }
}

TEST(Osm, RefusesOtherFiles) {
  const throng::testing::TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    write_file_atomically(folder.path() / "m.osm", text);
    return read_osm(folder.path() / "m.osm", {});
  };
  const std::string bomb =
      "<?xml version='1.0'?><!DOCTYPE o [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;'>]>"
      "<osm version='0.6'><node id='1' lat='0' lon='0'><tag k='name' v='&b;'/></node></osm>";
  for (const std::string& text :
       {std::string(), std::string("<osm version='0.6'/>"), std::string("<sdf/>"), bomb,
        std::string(
            "<osm version='0.6'><bounds minlat='0' minlon='0' maxlat='40' maxlon='40'/></osm>"),
        std::string(
            "<osm version='0.6'><bounds minlat='0' minlon='0' maxlat='1e-6' maxlon='1e-6'/></osm>"),
        std::string("<osm version='0.6'><node id='1' lat='1e300' lon='nan'/></osm>"),
        std::string("<osm version='0.6'><node id='1' lat='1' lon='2'/>")}) {
    EXPECT_THROW(read(text), InputError) << text;
  }
}

TEST(OsmBuildings, AreDrawnByTheirParts) {
  DrawnMap map;
  map.way(map.box(0, 0, 30, 20), "building=yes height=40 name=whole");
  map.way(map.box(0, 0, 20, 20), "building:part=yes height=6");
  map.way(map.box(5, 5, 15, 15), "building:part=yes height=30 min_height=6");   // a tower on it
  map.way(map.box(20, 0, 30, 10), "building:part=yes height=10 min_height=4");  // on stilts
  const ImportedScenario scenario = map.read();
  EXPECT_NEAR(height_at(scenario, {2, 2}), 6, 1e-9);
  EXPECT_NEAR(height_at(scenario, {10, 10}), 30, 1e-9);
  EXPECT_EQ(height_at(scenario, {25, 5}), 0);
  EXPECT_EQ(height_at(scenario, {25, 15}), 0);  // no part of it is there
  ASSERT_EQ(scenario.objects.size(), 1U);       // what people of another building would pass below
  for (const Eigen::Vector2d& point : {Eigen::Vector2d(2, 2), {10, 10}, {25, 5}, {25, 15}}) {
    EXPECT_TRUE(stops_people(scenario, point)) << point.transpose();
  }
  EXPECT_TRUE(std::any_of(scenario.skipped.begin(), scenario.skipped.end(), [](const Skipped& one) {
    return one.reason.find("100 m² of it bare") != std::string::npos;
  }));
}

TEST(OsmBuildings, TakeHeightsFromTagsAsTheWikiSays) {
  EXPECT_EQ(building_height_m({{"building", "yes"}, {"height", "12"}, {"roof:height", "4"}}), 12);
  EXPECT_EQ(building_height_m({{"building:levels", "3"}, {"roof:height", "4"}}), 13);
  EXPECT_EQ(building_height_m({{"building:levels", "3"}, {"roof:levels", "1"}}), 12);
}

TEST(OsmFile, RepairsAreasThatLibosmiumGivesUp) {
  DrawnMap map;
  // A house whose last corners are swapped, and a multipolygon with a label among its members.
  map.way(map.ring({{-40, 0}, {-20, 0}, {-20, 20}, {-40, 20}, {-39, -1}, {-40, 1}}),
          "building=yes height=7");
  const int outer = map.way(map.box(0, 0, 30, 30), "");
  const int inner = map.way(map.box(10, 10, 20, 20), "");
  const int label = map.node(15, 15);
  map.relation(fmt::format("<member type='way' ref='{}' role='outer'/><member type='way' ref='{}' "
                           "role='inner'/><member type='node' ref='{}' role='label'/>",
                           outer, inner, label),
               "type=multipolygon building=yes height=8");
  const ImportedScenario scenario = map.read();
  EXPECT_NEAR(height_at(scenario, {-30, 10}), 7, 1e-9);
  EXPECT_NEAR(height_at(scenario, {5, 5}), 8, 1e-9);
  EXPECT_EQ(height_at(scenario, {15, 15}), 0);
  EXPECT_FALSE(stops_people(scenario, {15, 15}));
}

TEST(OsmFile, KnowsTagsOnOuterWaysAndObjectsThatJosmDeleted) {
  DrawnMap map;
  const int outer = map.way(map.box(0, 0, 30, 30), "building=yes height=8");
  const int inner = map.way(map.box(10, 10, 20, 20), "");
  map.relation(fmt::format("<member type='way' ref='{}' role='outer'/><member type='way' ref='{}' "
                           "role='inner'/>",
                           outer, inner),
               "type=multipolygon");
  map.way(map.box(-30, 0, -10, 20), "building=yes", "action='delete'");
  map.way(map.box(-30, -30, -10, -10), "leisure=pitch barrier=fence");
  const ImportedScenario scenario = map.read();
  EXPECT_NEAR(height_at(scenario, {5, 5}), 8, 1e-9);
  EXPECT_EQ(height_at(scenario, {15, 15}), 0);
  EXPECT_EQ(height_at(scenario, {-20, 10}), 0);
  EXPECT_TRUE(stops_people(scenario, {-30, -20}));  // the fence
  EXPECT_FALSE(stops_people(scenario, {-20, -20}));
  EXPECT_EQ(scenario.areas.at(0).material, "grass");
}

TEST(OsmFile, ReadsWaysThatCarryTheirPositions) {  // Overpass's "out geom"
  const throng::testing::TemporaryFolder folder;
  write_file_atomically(
      folder.path() / "m.osm",
      "<osm version='0.6'><note>c</note><meta osm_base='2024-01-01T00:00:00Z'/><way id='1'>"
      "<bounds minlat='0' minlon='0' maxlat='0.001' maxlon='0.001'/>"
      "<nd ref='1' lat='0' lon='0'/><nd ref='2' lat='0' lon='0.001'/>"
      "<nd ref='3' lat='0.001' lon='0.001'/><nd ref='4' lat='0.001' lon='0'/>"
      "<nd ref='1' lat='0' lon='0'/><tag k='building' v='yes'/></way></osm>");
  const ImportedScenario scenario = read_osm(folder.path() / "m.osm", {});
  ASSERT_EQ(scenario.buildings.size(), 1U);
  EXPECT_NEAR(geometry::signed_area(scenario.buildings[0].footprint), 111.3 * 110.6, 50);
}

}  // namespace
}  // namespace throng::imports
