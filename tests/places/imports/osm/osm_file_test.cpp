// Extracts of OpenStreetMap: projection, rings and relations, and what is refused. The oracle for
// coordinates is the exact conversion to Earth-centered ones and to a local plane.
#include "places/imports/osm/osm_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "places/imports/osm/osm_rings.h"
#include "places/imports/osm/osm_text.h"
#include "tests/places/imports/drawn_map.h"

namespace throng::imports {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using imports_testing::DrawnMap;
using imports_testing::mentions;
using ::testing::HasSubstr;

OsmFile read_text(const std::string& text, const std::optional<GeoPoint>& origin = std::nullopt) {
  const throng::testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "m.osm", text);
  return read_osm_file(folder.path() / "m.osm", origin);
}

std::string read_error(const std::string& text,
                       const std::optional<GeoPoint>& origin = std::nullopt) {
  try {
    read_text(text, origin);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Earth-centered coordinates of a point on WGS 84 (a = 6 378 137 m, 1 / f = 298.257223563).
Vector3d geocentric(double latitude_deg, double longitude_deg) {
  constexpr double kA = 6378137.0;
  constexpr double kF = 1 / 298.257223563;
  const double e2 = kF * (2 - kF);
  const double phi = latitude_deg * std::numbers::pi / 180;
  const double lambda = longitude_deg * std::numbers::pi / 180;
  const double n = kA / std::sqrt(1 - e2 * std::sin(phi) * std::sin(phi));
  return {n * std::cos(phi) * std::cos(lambda), n * std::cos(phi) * std::sin(lambda),
          n * (1 - e2) * std::sin(phi)};
}

/// East and north of a point in the plane that touches the ellipsoid at the origin.
Vector2d east_north(const GeoPoint& origin, double latitude_deg, double longitude_deg) {
  const double phi = origin.latitude_deg * std::numbers::pi / 180;
  const double lambda = origin.longitude_deg * std::numbers::pi / 180;
  const Vector3d d = geocentric(latitude_deg, longitude_deg) -
                     geocentric(origin.latitude_deg, origin.longitude_deg);
  const Vector3d east(-std::sin(lambda), std::cos(lambda), 0);
  const Vector3d north(-std::sin(phi) * std::cos(lambda), -std::sin(phi) * std::sin(lambda),
                       std::cos(phi));
  return {east.dot(d), north.dot(d)};
}

class Projected : public ::testing::TestWithParam<GeoPoint> {};

TEST_P(Projected, IsEastAndNorthOfTheOrigin) {
  const GeoPoint origin = GetParam();
  for (const auto& [dlat, dlon] : {std::pair(0.0, 0.0), std::pair(0.004, 0.0),
                                   std::pair(0.0, -0.004), std::pair(-0.003, 0.005)}) {
    const double latitude = origin.latitude_deg + dlat;
    const double longitude = origin.longitude_deg + dlon;
    const OsmFile file =
        read_text(fmt::format("<osm version='0.6'><node id='5' lat='{:.7f}' lon='{:.7f}'>"
                              "<tag k='natural' v='tree'/></node></osm>",
                              latitude, longitude),
                  origin);
    ASSERT_EQ(file.points.size(), 1);
    const Vector2d expected = east_north(origin, latitude, longitude);
    // Within 500 m the convergence of meridians is below half a meter up to 70 degrees.
    EXPECT_LT((file.points[0].position - expected).norm(), 0.02 + 0.001 * expected.norm());
    EXPECT_EQ(file.points[0].id, 5);
    EXPECT_EQ(file.points[0].tags.at("natural"), "tree");
  }
}

INSTANTIATE_TEST_SUITE_P(Points, Projected,
                         ::testing::Values(GeoPoint{0, 0}, GeoPoint{48.137, 11.575},
                                           GeoPoint{-33.86, 151.21}, GeoPoint{64.15, -21.94}));

TEST(Projection, HasItsOriginInTheMiddleOfTheBounds) {
  const OsmFile file = read_text(
      "<osm version='0.6'><bounds minlat='50' minlon='8' maxlat='50.01' maxlon='8.02'/>"
      "<node id='1' lat='50.005' lon='8.01'><tag k='a' v='b'/></node></osm>");
  EXPECT_NEAR(file.points.at(0).position.norm(), 0, 0.02);
  EXPECT_TRUE(file.has_bounds);
  const Vector2d high = east_north({50.005, 8.01}, 50.01, 8.02);
  EXPECT_NEAR(file.bounds.max.x(), high.x(), 0.2);
  EXPECT_NEAR(file.bounds.max.y(), high.y(), 0.2);
  EXPECT_LT((file.bounds.min + file.bounds.max).norm(), 0.02);
}

TEST(Projection, TakesBoundsFromNodesWhereTheFileHasNone) {
  const OsmFile file = read_text(
      "<osm version='0.6'><node id='1' lat='50' lon='8'/><node id='2' lat='50.01' lon='8.02'/>"
      "</osm>");
  EXPECT_FALSE(file.has_bounds);
  const Vector2d size = file.bounds.max - file.bounds.min;
  EXPECT_NEAR(size.x(), 2 * east_north({50.005, 8.01}, 50.005, 8.02).x(), 0.2);
  EXPECT_NEAR(size.y(), 2 * east_north({50.005, 8.01}, 50.01, 8.01).y(), 0.2);
}

TEST(OsmAreas, JoinSplitAndReversedOuterWays) {
  DrawnMap map;
  const int a = map.node(0, 0);
  const int b = map.node(30, 0);
  const int c = map.node(30, 20);
  const int d = map.node(0, 20);
  const int lower = map.way({a, b, c}, "");
  const int upper = map.way({a, d, c}, "");  // in the other direction
  const int relation = map.relation(map.member(upper, "outer") + map.member(lower, "outer"),
                                    "type=multipolygon landuse=grass");
  const OsmFile file = map.read_file();
  ASSERT_EQ(file.areas.size(), 1);
  EXPECT_EQ(file.areas[0].name, fmt::format("relation {}", relation));
  EXPECT_EQ(file.areas[0].tags.at("landuse"), "grass");
  EXPECT_NEAR(size_m2(file.areas[0].area), 30 * 20, 0.5);
  EXPECT_TRUE(file.skipped.empty());
}

TEST(OsmAreas, KeepSeveralOutersAndTheirHoles) {
  DrawnMap map;
  const int left = map.way(map.box(-40, 0, -20, 20), "");
  const int right = map.way(map.box(0, 0, 30, 30), "");
  const int hole = map.way(map.box(10, 10, 20, 20), "");
  const int island = map.way(map.box(13, 13, 17, 17), "");
  map.relation(map.member(left, "outer") + map.member(hole, "inner") + map.member(right, "outer") +
                   map.member(island, "outer"),
               "type=multipolygon natural=water");
  const OsmFile file = map.read_file();
  double total = 0;
  std::size_t holes = 0;
  for (const OsmArea& area : file.areas) {
    total += size_m2(area.area);
    holes += area.area.holes.size();
  }
  EXPECT_EQ(file.areas.size(), 3);
  EXPECT_EQ(holes, 1);
  EXPECT_NEAR(total, 20 * 20 + 30 * 30 - 10 * 10 + 4 * 4, 1);
}

TEST(OsmAreas, AreClosedWaysWithCertainTags) {
  DrawnMap map;
  map.way(map.box(0, 0, 10, 10), "building=yes");
  map.way(map.box(20, 0, 30, 10), "highway=pedestrian area=yes");
  map.way(map.box(0, 20, 10, 30), "highway=service");                             // a roundabout
  map.way(map.box(20, 20, 30, 30), "leisure=track area=no");                      // a loop
  map.way({map.node(-10, 0), map.node(-5, 0), map.node(-5, 5)}, "building=yes");  // not closed
  map.way(map.box(-30, -30, -20, -20), "");                                       // says nothing
  const OsmFile file = map.read_file();
  EXPECT_EQ(file.areas.size(), 2);
  EXPECT_EQ(file.lines.size(), 3);
  for (const OsmLine& line : file.lines) EXPECT_EQ(line.points.size(), line.nodes.size());
}

TEST(OsmAreas, RepairAFigureOfEight) {
  DrawnMap map;
  map.way(map.ring({{0, 0}, {20, 20}, {20, 0}, {0, 20}}), "landuse=grass");
  const OsmFile file = map.read_file();
  double total = 0;
  for (const OsmArea& area : file.areas) total += size_m2(area.area);
  EXPECT_NEAR(total, 200, 1) << "two triangles of 100 m^2";
}

TEST(OsmSkipped, ReportsIncompleteAreas) {
  DrawnMap map;
  const int whole = map.way(map.box(0, 0, 20, 20), "");
  const int torn = map.way({map.node(30, 0), 9999, map.node(40, 10), map.node(30, 10)}, "");
  const int cut = map.relation(map.member(whole, "outer") + map.member(8888, "outer"),
                               "type=multipolygon landuse=grass");
  const int of_torn = map.relation(map.member(torn, "outer"), "type=multipolygon landuse=grass");
  const int no_outer = map.relation(map.member(whole, "inner"), "type=multipolygon landuse=grass");
  const int a = map.node(-30, 0);
  const int open = map.way({map.node(-40, 0), 7777, map.node(-35, 5), a}, "building=yes");
  const OsmFile file = map.read_file();
  EXPECT_TRUE(file.areas.empty());
  EXPECT_TRUE(mentions(file.skipped, fmt::format("relation {}: way 8888 is not whole", cut)));
  EXPECT_TRUE(
      mentions(file.skipped, fmt::format("relation {}: way {} is not whole", of_torn, torn)));
  EXPECT_TRUE(mentions(file.skipped,
                       fmt::format("relation {}: a multipolygon without an outer", no_outer)));
  // A line keeps the nodes that the file has.
  ASSERT_EQ(file.lines.size(), 1);
  EXPECT_EQ(file.lines[0].id, open);
  EXPECT_EQ(file.lines[0].points.size(), 3);
}

TEST(OsmSkipped, SaysWhichClosedWayHasNodesElsewhere) {
  DrawnMap map;
  const int a = map.node(0, 0);
  const int way = map.way({a, map.node(10, 0), 5555, map.node(0, 10), a}, "building=yes");
  const OsmFile file = map.read_file();
  EXPECT_TRUE(file.areas.empty());
  EXPECT_TRUE(
      mentions(file.skipped, fmt::format("way {}: some of its nodes are not in the file", way)));
}

TEST(OsmSkipped, SaysWhichRingDoesNotClose) {
  DrawnMap map;
  const int open = map.way({map.node(0, 0), map.node(10, 0), map.node(10, 10)}, "");
  const int relation = map.relation(map.member(open, "outer"), "type=multipolygon landuse=grass");
  const int closed = map.way(map.box(20, 20, 40, 40), "");
  const int partly = map.relation(map.member(open, "outer") + map.member(closed, "outer"),
                                  "type=multipolygon landuse=grass");
  const OsmFile file = map.read_file();
  EXPECT_TRUE(mentions(file.skipped,
                       fmt::format("relation {}: its edges cross or do not close", relation)));
  EXPECT_TRUE(
      mentions(file.skipped, fmt::format("relation {}: parts of it that do not close", partly)));
  ASSERT_EQ(file.areas.size(), 1);
  EXPECT_NEAR(size_m2(file.areas[0].area), 400, 1);
}

TEST(OsmDeleted, NodesAndRelationsAreNotThere) {
  DrawnMap map;
  map.node(0, 0);
  const int way = map.way(map.box(0, 0, 20, 20), "");
  map.relation(map.member(way, "outer"), "type=multipolygon landuse=grass", "action='delete'");
  map.relation(map.member(way, "outer"), "type=multipolygon landuse=grass", "visible='false'");
  map.way({map.node(0, 0, "action='delete'"), map.node(5, 0), map.node(9, 0)}, "highway=path");
  const OsmFile file = map.read_file();
  EXPECT_TRUE(file.areas.empty());
  ASSERT_EQ(file.lines.size(), 1);
  EXPECT_EQ(file.lines[0].points.size(), 2);
}

TEST(OsmErrors, NameTheFileAndTheExpectedContent) {
  EXPECT_THAT(read_error("no map"), HasSubstr("an extract of OpenStreetMap"));
  EXPECT_THAT(read_error("<osm version='0.6'></osm>"), HasSubstr("no bounds and no nodes"));
  EXPECT_THAT(read_error("<osm version='0.6'><node id='1' lat='50' lon='8'/>"
                         "<node id='2' lat='50.1' lon='8'/></osm>"),
              ::testing::AllOf(HasSubstr("m.osm"), HasSubstr("bounds"), HasSubstr("at most 5 km"),
                               HasSubstr("m x 11123 m")));
  EXPECT_THAT(read_error("<osm version='0.6'><node id='1' lat='88' lon='8'/></osm>"),
              HasSubstr("not at a pole"));
  EXPECT_THAT(
      read_error("<osm version='0.6'><node id='1' lat='50' lon='8'/></osm>", GeoPoint{52, 8}),
      HasSubstr("near the origin"));
  EXPECT_THAT(read_error("<osm version='0.6'><node id='1' lat='50' lon='8'><tag k='a'"),
              HasSubstr("m.osm"));
  EXPECT_EQ(read_error("<osm version='0.6'><node id='1' lat='50' lon='8'/></osm>", GeoPoint{50, 8}),
            "accepted");
}

TEST(OsmErrors, AMissingFileIsTheMachines) {
  EXPECT_THROW(read_osm_file("/nowhere/at/all.osm", std::nullopt), EnvironmentError);
}

WayNodes make_way(const std::vector<std::int64_t>& nodes) {
  WayNodes way;
  for (const std::int64_t node : nodes) {
    way.nodes.push_back(node);
    way.points.emplace_back(static_cast<double>(node), 0);
  }
  return way;
}

std::vector<std::vector<int>> join_rings(std::vector<WayNodes> parts, int open) {
  const JoinedRings joined = joined_rings(std::move(parts));
  EXPECT_EQ(joined.open, open);
  std::vector<std::vector<int>> rings;
  for (const Corners& ring : joined.rings) {
    auto& nodes = rings.emplace_back();
    for (const Vector2d& scenario : ring) nodes.push_back(static_cast<int>(scenario.x()));
  }
  return rings;
}

TEST(Rings, AreJoinedAtTheirEnds) {
  using Rings = std::vector<std::vector<int>>;
  EXPECT_EQ(join_rings({make_way({1, 2, 3}), make_way({3, 4, 1})}, 0), Rings({{1, 2, 3, 4}}));
  EXPECT_EQ(join_rings({make_way({1, 2, 3}), make_way({1, 4, 3})}, 0), Rings({{1, 2, 3, 4}}))
      << "the second one is turned";
  EXPECT_EQ(
      join_rings({make_way({1, 2}), make_way({5, 6, 7, 5}), make_way({3, 1}), make_way({2, 3})}, 0),
      Rings({{1, 2, 3}, {5, 6, 7}}));
  EXPECT_EQ(join_rings({make_way({1, 2, 3}), make_way({8, 9})}, 2), Rings{});
  EXPECT_EQ(join_rings({make_way({1}), make_way({})}, 0), Rings{}) << "no ways at all";
  EXPECT_EQ(join_rings({make_way({1, 2, 1})}, 1), Rings{}) << "there and back is no ring";
}

TEST(PlainText, LosesHistoryAndKeepsTheRest) {
  const OsmText plain = plain_osm(
      "<osm><node id='7' lat='1' user='a>b' uid='3'/><way id=\"8\" version='2' changeset='x' "
      "timestamp='t'><nd ref='7'/></way></osm>");
  EXPECT_THAT(plain.text, ::testing::Not(HasSubstr("version")));
  EXPECT_THAT(plain.text, ::testing::Not(HasSubstr("changeset")));
  EXPECT_THAT(plain.text, HasSubstr("<way id=\"8\">"));
  EXPECT_THAT(plain.text, HasSubstr("<nd ref='7'/>"));
  EXPECT_TRUE(plain.deleted.empty());
}

TEST(PlainText, KnowsObjectsThatJosmDeletedByKind) {
  const OsmText plain = plain_osm(
      "<node id='7' action='delete' lat='1'/><way id='7' action='modify'/>"
      "<relation id='-9' action='delete'></relation>");
  EXPECT_EQ(plain.deleted, (std::set<OsmId>{{'n', 7}, {'r', -9}}));
}

TEST(PlainText, DropsCoordinatesThatAreNone) {
  const OsmText plain =
      plain_osm("<node id='1' lat='nan' lon='2'/><node id='2' lat='1e999' lon='3.5'/>");
  EXPECT_EQ(plain.text, "<node id='1' lon='2'/><node id='2' lon='3.5'/>");
  EXPECT_EQ(plain_osm("").text, "");
  EXPECT_EQ(plain_osm("no tags").text, "no tags");
  EXPECT_EQ(plain_osm("<node id='1'").text, "<node id='1'");
}

}  // namespace
}  // namespace throng::imports
