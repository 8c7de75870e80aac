// Maps as points: what is built, painted, planted and walled, and where people come in.
#include "places/imports/osm/osm_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/geometry/polygon.h"
#include "places/imports/osm/osm_gates.h"
#include "tests/places/imports/drawn_map.h"

namespace throng::imports {
namespace {

using Eigen::Vector2d;
using imports_testing::DrawnMap;
using imports_testing::height_at;
using imports_testing::mentions;
using imports_testing::stops_people;
using imports_testing::way_text;

/// The material of the uppermost area at a point; empty: bare ground.
std::string ground_at(const ImportedScenario& scenario, const Vector2d& point) {
  std::string material;
  for (const world::GroundArea& area : scenario.areas) {
    if (geometry::distance_to(area.corners, point) == 0) material = area.material;
  }
  return material;
}

const Object* object_called(const ImportedScenario& scenario, const std::string& name) {
  for (const Object& object : scenario.objects) {
    if (object.name == name) return &object;
  }
  return nullptr;
}

/// Lowest and highest z of what is drawn.
std::pair<double, double> height_range(const Object& object) {
  std::pair<double, double> heights(1e9, -1e9);
  for (const Solid& solid : object.solids) {
    for (const auto& triangle : solid.triangles) {
      for (const Eigen::Vector3d& corner : triangle) {
        heights.first = std::min(heights.first, corner.z());
        heights.second = std::max(heights.second, corner.z());
      }
    }
  }
  return heights;
}

std::vector<world::Marking> select_markings(const ImportedScenario& scenario,
                                            const std::string& kind) {
  std::vector<world::Marking> found;
  for (const world::Marking& marking : scenario.markings) {
    if (marking.kind == kind) found.push_back(marking);
  }
  return found;
}

TEST(MapStreets, LieOnPathsAndThoseOnGreen) {
  DrawnMap map;
  map.way(map.box(-40, -40, 40, 40), "leisure=park");
  map.way({map.node(-40, 0), map.node(40, 0)}, "highway=residential");
  map.way({map.node(0, -40), map.node(0, 40)}, "highway=footway");
  map.way(map.box(20, 20, 30, 30), "amenity=parking");
  const ImportedScenario scenario = map.read();
  EXPECT_EQ(ground_at(scenario, {-20, 20}), "grass");
  EXPECT_EQ(ground_at(scenario, {25, 25}), "asphalt");
  EXPECT_EQ(ground_at(scenario, {0, 20}), "pavers");
  EXPECT_EQ(ground_at(scenario, {0, 0}), "asphalt") << "the street over the footway";
  EXPECT_EQ(ground_at(scenario, {20, 2.9}), "asphalt");
  EXPECT_EQ(ground_at(scenario, {20, 3.1}), "grass") << "6 m wide";
  EXPECT_EQ(ground_at(scenario, {1.3, 20}), "grass") << "2.5 m wide";
}

TEST(MapStreets, AreMarked) {
  DrawnMap map;
  const int crossing = map.node(10, 0, "");
  map.way({map.node(-40, 0), crossing, map.node(40, 0)}, "highway=tertiary");
  DrawnMap with_tag;
  with_tag.tagged_node(10, 0, "highway=crossing");
  with_tag.way({with_tag.node(-40, 0), 1, with_tag.node(40, 0)}, "highway=tertiary");
  EXPECT_TRUE(select_markings(map.read(), "crossing").empty());
  const ImportedScenario scenario = with_tag.read();
  const auto bars = select_markings(scenario, "crossing");
  ASSERT_EQ(bars.size(), 1);
  EXPECT_NEAR(bars[0].from.x(), 10, 0.05);
  EXPECT_NEAR(bars[0].to.x(), 10, 0.05);
  EXPECT_NEAR((bars[0].to - bars[0].from).norm(), 7 * 0.94, 0.01) << "7 m wide, clear of kerbs";
  EXPECT_NEAR(bars[0].width_m, 4, 1e-9);
  const auto dashes = select_markings(scenario, "dashes");
  ASSERT_EQ(dashes.size(), 2) << "one per segment";
  EXPECT_NEAR((dashes[0].to - dashes[0].from).norm(), 50 - 2 * 4, 0.1);
  EXPECT_NEAR((dashes[1].to - dashes[1].from).norm(), 30 - 2 * 4, 0.1);
}

TEST(MapStreets, AboveAndBelowTheGroundAreSkipped) {
  DrawnMap map;
  for (const char* where : {"tunnel=yes", "bridge=yes", "layer=1"}) {
    map.way({map.node(-40, 0), map.node(40, 0)}, std::string("highway=footway ") + where);
  }
  map.way({map.node(-40, 10), map.node(40, 10)}, "highway=motorway");
  map.way({map.node(-40, 20), map.node(40, 20)}, "highway=footway layer=-1");
  const ImportedScenario scenario = map.read();
  EXPECT_EQ(ground_at(scenario, {0, 0}), "");
  EXPECT_EQ(ground_at(scenario, {0, 10}), "");
  EXPECT_EQ(ground_at(scenario, {0, 20}), "pavers");
  EXPECT_TRUE(mentions(scenario.skipped, "way 3: a way above or below the ground"));
  EXPECT_TRUE(mentions(scenario.skipped, "highway=motorway has no ground here"));
}

TEST(MapBarriers, HaveGatesWhereMapsSay) {
  DrawnMap map;
  const int fence = map.way({map.node(-20, 0), map.node(20, 0)}, "barrier=fence height=1.8");
  map.tagged_node(5, 0, "barrier=gate");
  map.way({map.node(-20, 20), map.node(20, 20)}, "barrier=hedge");
  map.way({map.node(-20, 30), map.node(20, 30)}, "barrier=kerb");
  const ImportedScenario scenario = map.read();
  EXPECT_TRUE(stops_people(scenario, {0, 0}));
  EXPECT_TRUE(stops_people(scenario, {0, 0.14})) << "0.3 m wide";
  EXPECT_FALSE(stops_people(scenario, {0, 0.2}));
  EXPECT_FALSE(stops_people(scenario, {5, 0}));
  EXPECT_FALSE(stops_people(scenario, {6.1, 0})) << "2.4 m open";
  EXPECT_TRUE(stops_people(scenario, {6.3, 0}));
  EXPECT_TRUE(stops_people(scenario, {0, 20.35})) << "a hedge is 0.8 m wide";
  EXPECT_FALSE(stops_people(scenario, {0, 30})) << "people step over a kerb";
  const Object* object = object_called(scenario, fmt::format("fence {}", fence));
  ASSERT_NE(object, nullptr);
  EXPECT_NEAR(height_range(*object).first, 0, 1e-9);
  EXPECT_NEAR(height_range(*object).second, 1.8, 1e-9);
  EXPECT_TRUE(mentions(scenario.skipped, "barrier=kerb is not drawn"));
}

TEST(MapWater, IsDrawnAndStopsPeople) {
  DrawnMap map;
  const int outer = map.way(map.box(-20, -20, 20, 20), "");
  const int island = map.way(map.box(-5, -5, 5, 5), "");
  const int pond = map.relation(map.member(outer, "outer") + map.member(island, "inner"),
                                "type=multipolygon natural=water");
  const ImportedScenario scenario = map.read();
  EXPECT_TRUE(stops_people(scenario, {10, 10}));
  EXPECT_FALSE(stops_people(scenario, {0, 0}));
  const Object* object = object_called(scenario, fmt::format("relation {}", pond));
  ASSERT_NE(object, nullptr);
  EXPECT_NEAR(height_range(*object).second, 0.02, 1e-9);
}

TEST(MapBuildings, OnStiltsAndUndergroundAreNoObstacles) {
  DrawnMap map;
  const int roof = map.way(map.box(-30, 0, -10, 10), "building=roof height=5");
  const int high = map.way(map.box(10, 0, 30, 10), "building=yes min_height=4 height=10");
  const int cellar = map.way(map.box(10, 20, 30, 30), "building=yes location=underground");
  const int low = map.way(map.box(-30, 20, -10, 30), "building=yes min_height=1.5 height=6");
  const ImportedScenario scenario = map.read();
  EXPECT_FALSE(stops_people(scenario, {-20, 5}));
  EXPECT_FALSE(stops_people(scenario, {20, 5}));
  EXPECT_FALSE(stops_people(scenario, {20, 25}));
  EXPECT_TRUE(stops_people(scenario, {-20, 25})) << way_text(low) << " begins below heads";
  EXPECT_NEAR(height_at(scenario, {-20, 25}), 6, 1e-9);
  const Object* roof_object = object_called(scenario, way_text(roof));
  ASSERT_NE(roof_object, nullptr);
  EXPECT_NEAR(height_range(*roof_object).first, 4.7, 1e-9) << "0.3 m thick";
  EXPECT_NEAR(height_range(*roof_object).second, 5, 1e-9);
  const Object* high_object = object_called(scenario, way_text(high));
  ASSERT_NE(high_object, nullptr);
  EXPECT_NEAR(height_range(*high_object).first, 4, 1e-9);
  EXPECT_NEAR(height_range(*high_object).second, 10, 1e-9);
  EXPECT_TRUE(mentions(scenario.skipped, way_text(cellar) + ": is underground"));
}

TEST(MapBuildings, DoNotOverlap) {
  DrawnMap map;
  map.way(map.box(0, 0, 20, 20), "building=yes height=8");
  const int second = map.way(map.box(10, 0, 30, 20), "building=yes height=12");
  const ImportedScenario scenario = map.read();
  EXPECT_NEAR(height_at(scenario, {15, 10}), 8, 1e-9) << "the first keeps its ground";
  EXPECT_NEAR(height_at(scenario, {25, 10}), 12, 1e-9);
  double total = 0;
  for (const world::Building& building : scenario.buildings) {
    total += geometry::signed_area(building.footprint);
  }
  EXPECT_NEAR(total, 30 * 20, 1);
  EXPECT_TRUE(
      mentions(scenario.skipped, way_text(second) + ": 200 m² of it are in other buildings"));
}

TEST(MapBuildings, PartsTakeTheirBuildingsHeightsAndRoofs) {
  DrawnMap map;
  map.way(map.box(0, 0, 20, 20), "building=yes building:levels=4 roof:height=2");
  map.way(map.box(0, 0, 20, 12), "building:part=yes");
  map.way(map.box(0, 12, 20, 20), "building:part=yes building:levels=1");
  map.way(map.box(-30, -30, -20, -20), "building:part=yes height=7");
  const ImportedScenario scenario = map.read();
  EXPECT_NEAR(height_at(scenario, {10, 6}), 4 * 3 + 2, 1e-9);
  EXPECT_NEAR(height_at(scenario, {10, 16}), 3, 1e-9) << "its own levels, no roof";
  EXPECT_NEAR(height_at(scenario, {-25, -25}), 7, 1e-9) << "a part of no building";
}

TEST(MapProps, AreTreesLampsBenchesBinsAndBollards) {
  DrawnMap map;
  map.tagged_node(0, 0, "natural=tree height=12");
  map.tagged_node(10, 0, "highway=street_lamp");
  map.tagged_node(20, 0, "amenity=bench direction=90");
  map.tagged_node(30, 0, "natural=tree height=99");
  map.tagged_node(40, 0, "natural=tree height=1");
  map.tagged_node(500, 0, "natural=tree");
  map.tagged_node(-10, 0, "amenity=cafe");
  const ImportedScenario scenario = map.read();
  ASSERT_EQ(scenario.props.size(), 5) << "one is outside, one is none";
  EXPECT_EQ(scenario.props[0].kind, world::PropKind::tree);
  EXPECT_NEAR(scenario.props[0].scale, 1.5, 1e-9) << "of 8 m";
  EXPECT_EQ(scenario.props[1].kind, world::PropKind::lamp_post);
  EXPECT_NEAR((scenario.props[1].position - Vector2d(10, 0)).norm(), 0, 0.05);
  EXPECT_EQ(scenario.props[2].kind, world::PropKind::bench);
  // A sitting person looks east: to the right of a heading north, 90 degrees.
  EXPECT_NEAR(scenario.props[2].yaw_rad, std::acos(-1) / 2, 1e-9);
  EXPECT_EQ(scenario.props[3].scale, 2.5);
  EXPECT_EQ(scenario.props[4].scale, 0.4);
}

TEST(MapProps, StandInRowsEightMetersApart) {
  DrawnMap map;
  map.way({map.node(-20, 0), map.node(0, 0), map.node(0, 20)}, "natural=tree_row");
  const ImportedScenario scenario = map.read();
  ASSERT_EQ(scenario.props.size(), 6) << "0, 8, ..., 40 m along the row";
  const std::vector<Vector2d> expected = {{-20, 0}, {-12, 0}, {-4, 0}, {0, 4}, {0, 12}, {0, 20}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((scenario.props[i].position - expected[i]).norm(), 0.2) << i;
  }
}

TEST(MapSkipped, NamesLinesAndAreasThatAreNotDrawn) {
  DrawnMap map;
  map.way({map.node(-20, 0), map.node(20, 0)}, "power=line");
  map.way({map.node(-20, 5), map.node(20, 5)}, "waterway=stream");
  map.way({map.node(-20, 9), map.node(20, 9)}, "name=nothing");
  const int cliff = map.way(map.box(0, 20, 10, 30), "natural=cape");
  map.way(map.box(20, 20, 30, 30), "landuse=residential");
  const ImportedScenario scenario = map.read();
  EXPECT_TRUE(mentions(scenario.skipped, "power=line is not drawn"));
  EXPECT_TRUE(mentions(scenario.skipped, "waterway=stream is not drawn"));
  EXPECT_TRUE(mentions(scenario.skipped, way_text(cliff) + ": an area that is not drawn"));
  EXPECT_EQ(scenario.skipped.size(), 3);
}

TEST(MapGates, AreWhereStreetsCrossTheEdge) {
  DrawnMap map;
  map.way({map.node(-90, 0), map.node(90, 0)}, "highway=residential");
  map.way({map.node(0, -90), map.node(0, 30)}, "highway=footway");
  const ImportedScenario scenario = map.read();
  ASSERT_EQ(scenario.gates.size(), 3);
  double shares = 0;
  for (const Gate& gate : scenario.gates) {
    const Vector2d middle = 0.5 * (gate.from + gate.to);
    const bool west_or_east = std::abs(std::abs(middle.x()) - 55.66) < 0.1;
    EXPECT_TRUE(west_or_east || std::abs(middle.y() + 55.29) < 0.1) << middle.transpose();
    EXPECT_NEAR((gate.to - gate.from).norm(), west_or_east ? 6 : 2.5, 1e-6);
    EXPECT_NEAR(gate.share, west_or_east ? 0.3 * 6 : 2.5, 1e-6);
    shares += gate.share;
  }
  EXPECT_NEAR(shares, 2 * 1.8 + 2.5, 1e-6);
  EXPECT_TRUE(scenario.people_come);
  EXPECT_FALSE(scenario.gates_asked);
}

TEST(MapGates, AreThoseOfTheUserIfAny) {
  DrawnMap map;
  map.way({map.node(-90, 0), map.node(90, 0)}, "highway=residential");
  const ImportedScenario scenario = map.read({Gate{{-10, -55}, {-5, -55}, 1}});
  ASSERT_EQ(scenario.gates.size(), 1);
  EXPECT_EQ(scenario.gates[0].from, Vector2d(-10, -55));
  EXPECT_TRUE(scenario.gates_asked);
}

TEST(GatesAtEdge, JoinThoseThatOverlapAndLimitWidths) {
  const world::Rectangle inside{{0, 0}, {100, 50}};
  OsmLine first{1, {}, {{10, 20}, {10, -20}}, {1, 2}};
  OsmLine second{2, {}, {{12, 20}, {12, -20}}, {3, 4}};
  OsmLine wide{3, {}, {{60, 20}, {60, 60}}, {5, 6}};
  OsmLine stub{4, {}, {{90, 25}, {99.5, 25}}, {7, 8}};
  OsmLine inner{5, {}, {{30, 10}, {30, 40}}, {9, 10}};
  const auto kind = [](double width, bool road) { return WayKind{width, "asphalt", road, false}; };
  const std::vector<Gate> gates = gates_at_edge({{&first, kind(4, false)},
                                                 {&second, kind(4, false)},
                                                 {&wide, kind(30, true)},
                                                 {&stub, kind(0.5, false)},
                                                 {&inner, kind(4, false)}},
                                                inside);
  ASSERT_EQ(gates.size(), 3);
  EXPECT_LT((gates[0].from - Vector2d(8, 0)).norm(), 1e-9) << "8 to 14 m along the south side";
  EXPECT_LT((gates[0].to - Vector2d(14, 0)).norm(), 1e-9);
  EXPECT_NEAR(gates[0].share, 8, 1e-9) << "both widths";
  EXPECT_NEAR(gates[1].from.x(), 100, 1e-9) << "the way that ends within a meter of the edge";
  EXPECT_NEAR((gates[1].to - gates[1].from).norm(), 2, 1e-9) << "2 m at least";
  EXPECT_NEAR((gates[2].to - gates[2].from).norm(), 12, 1e-9) << "12 m at most";
  EXPECT_NEAR(gates[2].share, 0.3 * 12, 1e-9);
}

TEST(PartWithin, ClipsASegment) {
  const world::Rectangle area{{0, 0}, {10, 5}};
  const auto expect = [&](Vector2d from, Vector2d to, Vector2d first, Vector2d last) {
    const auto part = part_within(from, to, area);
    ASSERT_TRUE(part);
    EXPECT_LT((part->first - first).norm(), 1e-9);
    EXPECT_LT((part->second - last).norm(), 1e-9);
  };
  expect({2, 2}, {8, 3}, {2, 2}, {8, 3});
  expect({-10, 2}, {20, 2}, {0, 2}, {10, 2});
  expect({20, 2}, {-10, 2}, {10, 2}, {0, 2});
  expect({-5, -5}, {15, 15}, {0, 0}, {5, 5});
  expect({3, 2}, {3, 100}, {3, 2}, {3, 5});
  EXPECT_FALSE(part_within({-1, -1}, {-1, 9}, area)) << "beside it";
  EXPECT_FALSE(part_within({-1, 6}, {11, 6}, area)) << "above it";
  EXPECT_FALSE(part_within({-4, 0}, {0, -4}, area)) << "past a corner";
  EXPECT_FALSE(part_within({9.95, 2}, {20, 2}, area)) << "less than a decimeter";
}

std::string error_of_bounds(double degrees) {
  const throng::testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "m.osm",
                        fmt::format("<osm version='0.6'><bounds minlat='0' minlon='0' "
                                    "maxlat='{0}' maxlon='{0}'/></osm>",
                                    degrees));
  try {
    read_osm(folder.path() / "m.osm", {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MapErrors, TooSmallAMapIsRefused) {
  // A degree of latitude has 110 574 m at the equator.
  EXPECT_THAT(error_of_bounds(0.00018),
              ::testing::AllOf(::testing::HasSubstr("at least 20 m x 20 m"),
                               ::testing::HasSubstr("20.0 m x 19.9 m")));
  EXPECT_EQ(error_of_bounds(0.00019), "accepted");
}

TEST(MapErrors, AnEmptyMapHasANameAndOpenGround) {
  const throng::testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "Old Town.osm",
                        "<osm version='0.6'><bounds minlat='0' minlon='0' maxlat='0.001' "
                        "maxlon='0.001'/></osm>");
  const ImportedScenario scenario = read_osm(folder.path() / "Old Town.osm", {});
  EXPECT_EQ(scenario.name, "old_town");
  EXPECT_THAT(scenario.description, ::testing::HasSubstr("Old Town.osm"));
  EXPECT_TRUE(scenario.gates.empty());
  EXPECT_TRUE(scenario.buildings.empty() && scenario.objects.empty() && scenario.areas.empty());
}

}  // namespace
}  // namespace throng::imports
