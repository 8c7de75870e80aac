// Maps that are not quite as the wiki says: rings that close by place only or not at all,
// towers as the only parts, sizes that cannot be read, ways below buildings. Nothing of it
// disappears without a line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "places/imports/parts/populate.h"
#include "tests/places/imports/drawn_map.h"

namespace throng::imports {
namespace {

using Eigen::Vector2d;
using imports_testing::DrawnMap;
using imports_testing::height_at;
using imports_testing::mentions;
using imports_testing::stops_people;
using imports_testing::way_text;

TEST(MapRings, CloseWhereTheirEndsMeet) {
  DrawnMap map;
  map.way({map.node(0, 0), map.node(20, 0), map.node(20, 20), map.node(0, 20), map.node(0, 0)},
          "building=yes height=12");
  map.way({map.node(-20, 0), map.node(-10, 0), map.node(-10, 9), map.node(-20.02, 0.03)},
          "building=yes height=6");
  const ImportedScenario scenario = map.read();
  EXPECT_EQ(height_at(scenario, {10, 10}), 12);
  EXPECT_EQ(height_at(scenario, {-12, 2}), 6) << "the ends are 4 cm apart";
  EXPECT_TRUE(scenario.skipped.empty());
}

TEST(MapRings, OfMultipolygonsCloseByPlaceToo) {
  DrawnMap map;
  const int lower = map.way({map.node(0, 0), map.node(30, 0), map.node(30, 20)}, "");
  const int upper = map.way({map.node(30, 20), map.node(0, 20), map.node(0, 0)}, "");
  map.relation(map.member(lower, "outer") + map.member(upper, "outer"),
               "type=multipolygon building=yes height=5");
  const ImportedScenario scenario = map.read();
  EXPECT_EQ(height_at(scenario, {15, 10}), 5);
  EXPECT_TRUE(scenario.skipped.empty());
}

TEST(MapRings, ThatDoNotCloseAreListed) {
  for (const char* tags : {"building=yes", "building:part=yes", "landuse=grass", "leisure=park",
                           "natural=water", "amenity=parking", "area=yes"}) {
    DrawnMap map;
    const int way =
        map.way({map.node(0, 0), map.node(20, 0), map.node(20, 15), map.node(0, 15)}, tags);
    const ImportedScenario scenario = map.read();
    EXPECT_TRUE(mentions(scenario.skipped, way_text(way) + ": its ring does not close: the ends "
                                                           "are 15.0 m apart"))
        << tags;
  }
  DrawnMap torn;
  torn.way({torn.node(0, 0), torn.node(20, 0), 999, torn.node(0, 15)}, "building=yes");
  EXPECT_TRUE(mentions(torn.read().skipped, "1 of its nodes are not in the file"));
  DrawnMap gone;
  const int lost = gone.way({gone.node(0, 0), 998, 999}, "building=yes");
  EXPECT_TRUE(mentions(gone.read().skipped, way_text(lost) + ": 1 of its 3 nodes are in the file"));
}

TEST(MapRings, ThatAreEdgesOfMultipolygonsAreNotListed) {
  DrawnMap map;
  const int a = map.node(0, 0);
  const int c = map.node(30, 20);
  const int lower = map.way({a, map.node(30, 0), c}, "building=yes");
  const int upper = map.way({c, map.node(0, 20), a}, "building=yes");
  map.relation(map.member(lower, "outer") + map.member(upper, "outer"),
               "type=multipolygon building=yes height=5");
  const ImportedScenario scenario = map.read();
  EXPECT_EQ(height_at(scenario, {15, 10}), 5);
  EXPECT_TRUE(scenario.skipped.empty());
}

TEST(MapTowers, StandOnTheBodyOfTheirBuilding) {
  DrawnMap map;
  map.way(map.box(0, 0, 40, 15), "building=church height=15");
  map.way(map.box(0, 4, 7, 11), "building:part=tower height=60");
  map.way(map.box(30, 4, 34, 8), "building:part=tower height=20 min_height=15");  // a spire
  const ImportedScenario scenario = map.read();
  EXPECT_EQ(height_at(scenario, {3, 7}), 60);
  EXPECT_EQ(height_at(scenario, {20, 7}), 15);
  EXPECT_EQ(height_at(scenario, {3, 2}), 15);
  EXPECT_EQ(height_at(scenario, {32, 6}), 20);
  EXPECT_TRUE(scenario.objects.empty()) << "the spire stands on the body";
  EXPECT_TRUE(stops_people(scenario, {20, 7}));
  EXPECT_TRUE(scenario.skipped.empty());
}

TEST(MapTowers, LeaveABodyOfTheKindsHeightIfItHasNone) {
  DrawnMap map;
  map.way(map.box(0, 0, 40, 15), "building=church");
  map.way(map.box(0, 4, 7, 11), "building:part=tower height=60");
  const ImportedScenario scenario = map.read();
  EXPECT_EQ(height_at(scenario, {3, 7}), 60);
  EXPECT_EQ(height_at(scenario, {20, 7}), 9);
}

TEST(MapSizes, ThatCannotBeReadAreListed) {
  DrawnMap map;
  const int tall = map.way(map.box(0, 0, 10, 10), "building=yes height=tall");
  const int levels = map.way(map.box(20, 0, 30, 10), "building=house building:levels=two");
  const int wide = map.way({map.node(-40, -20), map.node(40, -20)}, "highway=path width=narrow");
  const int fence = map.way({map.node(-40, 30), map.node(0, 30)}, "barrier=fence height=low");
  map.tagged_node(-20, 20, "natural=tree height=big");
  const ImportedScenario scenario = map.read();
  EXPECT_TRUE(mentions(scenario.skipped, way_text(tall) + ": height=tall"));
  EXPECT_TRUE(mentions(scenario.skipped, "reaches from 0 to 9 m"));
  EXPECT_TRUE(mentions(scenario.skipped, way_text(levels) + ": building:levels=two"));
  EXPECT_TRUE(mentions(scenario.skipped, way_text(wide) + ": width=narrow"));
  EXPECT_TRUE(mentions(scenario.skipped, way_text(fence) + ": height=low"));
  EXPECT_TRUE(mentions(scenario.skipped, "height=big"));
  EXPECT_EQ(scenario.skipped.size(), 5);
}

/// A house around a courtyard of 20 m x 20 m, with a way to it from the south.
DrawnMap courtyard(const std::string& way_tags, const std::string& building_tags) {
  DrawnMap map;
  const int outer = map.way(map.box(-20, -20, 20, 20), "");
  const int inner = map.way(map.box(-10, -10, 10, 10), "");
  map.relation(map.member(outer, "outer") + map.member(inner, "inner"),
               "type=multipolygon " + building_tags);
  const int street = map.node(0, -20);
  const int yard = map.node(0, -10);
  map.way({map.node(0, -60), street}, "highway=footway");
  map.way({street, yard}, way_tags);
  map.way({yard, map.node(0, 5)}, "highway=footway");
  return map;
}

TEST(MapPassages, LetPeopleThroughBelowTheBuilding) {
  ImportedScenario scenario =
      courtyard("highway=service tunnel=building_passage width=4", "building=yes height=12").read();
  EXPECT_FALSE(stops_people(scenario, {0, -15}));
  EXPECT_TRUE(stops_people(scenario, {3, -15})) << "the passage is 4 m wide";
  EXPECT_EQ(height_at(scenario, {3, -15}), 12);
  ASSERT_EQ(scenario.objects.size(), 1) << "the building above it";
  double low = 1e9;
  double high = 0;
  for (const auto& triangle : scenario.objects[0].solids.at(0).triangles) {
    for (const Eigen::Vector3d& corner : triangle) {
      EXPECT_LE(std::abs(corner.x()), 2.1);
      low = std::min(low, corner.z());
      high = std::max(high, corner.z());
    }
  }
  EXPECT_NEAR(low, 3, 1e-9);
  EXPECT_NEAR(high, 12, 1e-9);
  const Population population = populate(scenario, {400, 1});
  EXPECT_TRUE(std::any_of(population.starts.begin(), population.starts.end(),
                          [](const Vector2d& p) { return p.cwiseAbs().maxCoeff() < 9; }))
      << "people who leave the courtyard";
  EXPECT_FALSE(mentions(scenario.skipped, "nobody is on"));
}

TEST(MapPassages, HaveTheHeightOfTheirTags) {
  const ImportedScenario scenario =
      courtyard("highway=footway covered=yes maxheight=4.5__m", "building=yes height=12").read();
  EXPECT_FALSE(stops_people(scenario, {0, -15}));
  double low = 1e9;
  for (const auto& triangle : scenario.objects.at(0).solids.at(0).triangles) {
    for (const Eigen::Vector3d& corner : triangle) low = std::min(low, corner.z());
  }
  EXPECT_NEAR(low, 4.5, 1e-9);
}

TEST(MapPassages, LeadThroughBuildingsWithParts) {
  DrawnMap map;
  map.way(map.box(-20, -10, 20, 10), "building=yes height=12");
  map.way(map.box(-20, -10, 5, 10), "building:part=yes height=12");
  map.way(map.box(5, -10, 20, 10), "building:part=yes height=20");
  map.way({map.node(0, -10), map.node(0, 10)}, "highway=footway tunnel=building_passage");
  const ImportedScenario scenario = map.read();
  EXPECT_FALSE(stops_people(scenario, {0, 0}));
  EXPECT_TRUE(stops_people(scenario, {10, 0}));
  EXPECT_EQ(height_at(scenario, {0, 0}), 0);
  EXPECT_EQ(scenario.objects.size(), 1);
}

TEST(MapPassages, BelowLowBuildingsAreListed) {
  DrawnMap map;
  map.way(map.box(-20, -10, 20, 10), "building=yes height=2.2");
  const int way =
      map.way({map.node(0, -10), map.node(0, 10)}, "highway=footway tunnel=building_passage");
  const ImportedScenario scenario = map.read();
  EXPECT_TRUE(stops_people(scenario, {0, 0}));
  EXPECT_TRUE(mentions(scenario.skipped, way_text(way) + ": a passage below"));
}

TEST(MapSkipped, HasALineForEachKindOfNode) {
  DrawnMap map;
  const int first = map.tagged_node(0, 0, "amenity=cafe");
  const int second = map.tagged_node(5, 0, "amenity=cafe");
  map.tagged_node(9, 9, "building=yes");
  map.tagged_node(20, 0, "barrier=gate");
  map.tagged_node(20, 9, "name=nothing");
  map.tagged_node(500, 9, "natural=tree");
  map.way(map.box(500, 0, 510, 10), "building=yes");
  map.way({map.node(500, 0), map.node(510, 0)}, "highway=footway");
  const ImportedScenario scenario = map.read();
  EXPECT_TRUE(mentions(scenario.skipped,
                       fmt::format("nodes {}, {}: amenity=cafe is not drawn", first, second)));
  EXPECT_TRUE(mentions(scenario.skipped, "building=yes is not drawn"));
  EXPECT_TRUE(mentions(scenario.skipped, "1 trees, lamps and other props are outside"));
  EXPECT_TRUE(mentions(scenario.skipped, "edge: 2 areas and ways are outside of it"));
  EXPECT_EQ(scenario.skipped.size(), 4);
}

TEST(MapSkipped, NamesBridgesTinyBuildingsAndRelationsOfOtherTypes) {
  DrawnMap map;
  const int bridge = map.way({map.node(-40, 0), map.node(40, 0)}, "highway=footway bridge=viaduct");
  const int tiny = map.way(map.box(0, 10, 0.5, 10.5), "building=yes");
  const int ring = map.way(map.box(20, 20, 30, 30), "");
  const int relation = map.relation(map.member(ring, "outer"), "type=boundary landuse=grass");
  const ImportedScenario scenario = map.read();
  EXPECT_TRUE(mentions(scenario.skipped, way_text(bridge) + ": a way above or below the ground"));
  EXPECT_TRUE(mentions(scenario.skipped, way_text(tiny) + ": covers 0.25 m"));
  EXPECT_TRUE(mentions(scenario.skipped, fmt::format("relation {}: its type is", relation)));
}

}  // namespace
}  // namespace throng::imports
