// People and exits of scenarios made by hand, and what is written for them.
#include "places/imports/parts/populate.h"

#include <fmt/core.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "places/imports/parts/scenario_name.h"
#include "places/imports/parts/scenario_writer.h"
#include "tests/world/temporary_folder.h"

namespace throng::imports {
namespace {

using Eigen::Vector2d;
using nlohmann::json;
using ::testing::HasSubstr;

/// 40 m x 20 m of open ground with a house of 10 m x 10 m in its middle.
ImportedScenario field() {
  ImportedScenario scenario;
  scenario.name = "field";
  scenario.inside = {{0, 0}, {40, 20}};
  scenario.obstacles = {rectangle_corners({{15, 5}, {25, 15}})};
  scenario.buildings = {{"b1", scenario.obstacles[0], 6, world::Facade::by_id}};
  return scenario;
}

/// Walls 0.5 m thick along a rectangle's sides.
void wall_in(ImportedScenario& scenario, const world::Rectangle& around) {
  const auto& [low, high] = around;
  for (const world::Rectangle& wall :
       {world::Rectangle{low - Vector2d(1, 1), {high.x() + 1, low.y()}},
        {{low.x() - 1, high.y()}, high + Vector2d(1, 1)},
        {low - Vector2d(1, 1), {low.x(), high.y() + 1}},
        {{high.x(), low.y() - 1}, high + Vector2d(1, 1)}}) {
    scenario.obstacles.push_back(rectangle_corners(wall));
  }
}

bool noted(const ImportedScenario& scenario, const std::string& words) {
  return std::any_of(scenario.skipped.begin(), scenario.skipped.end(), [&](const Skipped& skipped) {
    return skipped.text().find(words) != std::string::npos;
  });
}

TEST(Starts, AreApartInsideAndOnFreeGround) {
  ImportedScenario scenario = field();
  const Population population = populate(scenario, {150, 5});
  ASSERT_EQ(population.starts.size(), 150);
  for (std::size_t i = 0; i < 150; ++i) {
    const Vector2d& start = population.starts[i];
    EXPECT_TRUE(start.x() >= 2 && start.x() <= 38 && start.y() >= 2 && start.y() <= 18);
    EXPECT_GE(geometry::distance_to(scenario.obstacles[0], start), 0.35);
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE((start - population.starts[k]).norm(), 0.9) << i << ", " << k;
    }
  }
}

TEST(Starts, FollowTheSeed) {
  const auto starts = [](std::uint64_t seed) {
    ImportedScenario scenario = field();
    return populate(scenario, {40, seed}).starts;
  };
  EXPECT_EQ(starts(1), starts(1));
  EXPECT_NE(starts(1), starts(2));
}

TEST(Starts, AreAsManyAsHaveRoom) {
  ImportedScenario scenario = field();
  scenario.inside = {{0, 0}, {12, 12}};
  scenario.obstacles.clear();
  scenario.buildings.clear();
  const Population population = populate(scenario, {1000, 1});
  // 8 m x 8 m, each with a disc of radius 0.45 m; at least one per (2 x 0.9 m)^2.
  EXPECT_LT(population.starts.size(), 17 * 17);
  EXPECT_GT(population.starts.size(), 25);
  EXPECT_TRUE(
      noted(scenario, fmt::format("there is room for {} of 1000", population.starts.size())));
}

TEST(FoundGates, AreOnTheOpenEdge) {
  ImportedScenario scenario = field();
  const Population population = populate(scenario, {10, 1});
  ASSERT_EQ(population.gates.size(), 4) << "one per side";
  for (const Gate& gate : population.gates) {
    EXPECT_NEAR((gate.to - gate.from).norm(), 8, 1e-9) << "no wider than 8 m";
    const Vector2d middle = 0.5 * (gate.from + gate.to);
    const Vector2d out = outward_direction(gate, scenario.inside);
    EXPECT_NEAR(out.norm(), 1, 1e-12);
    EXPECT_FALSE(scenario.inside.contains(middle + 0.1 * out));
    EXPECT_TRUE(scenario.inside.contains(middle - 0.1 * out));
  }
}

TEST(FoundGates, AreBetweenWallsWideEnough) {
  ImportedScenario scenario;
  scenario.name = "yard";
  scenario.inside = {{0, 0}, {30, 30}};
  wall_in(scenario, {{0, 0}, {30, 30}});
  // The south wall is replaced by two pieces with 4 m between them.
  scenario.obstacles[0] = rectangle_corners({{-1, -1}, {13, 0}});
  scenario.obstacles.push_back(rectangle_corners({{17, -1}, {31, 0}}));
  const Population population = populate(scenario, {10, 1});
  ASSERT_EQ(population.gates.size(), 1);
  const Gate& gate = population.gates[0];
  EXPECT_NEAR((0.5 * (gate.from + gate.to) - Vector2d(15, 0)).norm(), 0, 0.51);
  EXPECT_GE((gate.to - gate.from).norm(), 1.2);
  EXPECT_LE((gate.to - gate.from).norm(), 4);
}

TEST(GivenGates, ThatCannotBeReachedAreNoted) {
  ImportedScenario scenario = field();
  wall_in(scenario, {{30, 0}, {40, 20}});  // a cell in the east
  scenario.gates = {{{0, 8}, {0, 12}, 1}, {{40, 8}, {40, 12}, 1}};
  const Population population = populate(scenario, {10, 1});
  ASSERT_EQ(population.gates.size(), 1);
  EXPECT_EQ(population.gates[0].from, Vector2d(0, 8));
  EXPECT_TRUE(noted(scenario, "exit from [40.0, 8.0] to [40.0, 12.0]: cannot be reached"));
  for (const Vector2d& start : population.starts) EXPECT_LT(start.x(), 29);
}

TEST(GivenGates, ThatAreWalledUpGiveWayToOpenGround) {
  ImportedScenario scenario = field();
  scenario.obstacles.push_back(rectangle_corners({{-2, 6}, {2, 14}}));
  scenario.gates = {{{0, 8}, {0, 12}, 1}};
  EXPECT_FALSE(populate(scenario, {5, 1}).gates.empty());
  EXPECT_TRUE(noted(scenario, "all ways out are walled up: open ground instead"));
  scenario.gates_asked = true;
  try {
    populate(scenario, {5, 1});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                ::testing::AllOf(HasSubstr("field"), HasSubstr("walled up"), HasSubstr("--exit")));
  }
}

TEST(Enclosed, GroundIsMeasured) {
  ImportedScenario scenario = field();
  wall_in(scenario, {{30, 5}, {38, 15}});  // 8 m x 10 m that nobody reaches
  populate(scenario, {5, 1});
  bool found = false;
  for (const Skipped& skipped : scenario.skipped) {
    double area = 0;
    if (std::sscanf(skipped.reason.c_str(), "nobody is on %lf", &area) != 1) continue;
    found = true;
    EXPECT_NEAR(area, 7.3 * 9.3, 9) << "less half a body along the walls";
  }
  EXPECT_TRUE(found);
}

TEST(OpenGround, IsTheFreeAreaInside) {
  ImportedScenario scenario = field();
  const double free_m2 = 40 * 20 - 10.7 * 10.7;
  EXPECT_NEAR(open_ground_m2(scenario), free_m2, 0.05 * free_m2);
  scenario.obstacles = {rectangle_corners({{-20, -20}, {60, 40}})};
  EXPECT_EQ(open_ground_m2(scenario), 0);
}

TEST(Props, InBuildingsAndBeforeExitsAreTakenAway) {
  ImportedScenario scenario = field();
  scenario.gates = {{{0, 8}, {0, 12}, 1}};
  const auto tree = [](double x, double y) {
    world::Prop prop;
    prop.kind = world::PropKind::bollard;
    prop.position = {x, y};
    return prop;
  };
  scenario.props = {tree(20, 10), tree(0.5, 9), tree(30, 3)};
  populate(scenario, {5, 1});
  ASSERT_EQ(scenario.props.size(), 1);
  EXPECT_EQ(scenario.props[0].position, Vector2d(30, 3));
  EXPECT_TRUE(noted(scenario, "bollard at [20.0, 10.0]: stands in a building or before an exit"));
  EXPECT_TRUE(noted(scenario, "bollard at [0.5, 9.0]"));
}

TEST(Footprints, TurnAndGrowWithTheirProps) {
  world::Prop bench;
  bench.kind = world::PropKind::bench;
  bench.position = {10, 20};
  const Vector2d half = world::prop_type(bench.kind).half_size;
  const geometry::Rectangle straight = geometry::bounding_box(world::prop_footprint(bench));
  EXPECT_LT((straight.max - bench.position - half).norm(), 1e-12);
  bench.yaw_rad = std::numbers::pi / 2;
  bench.scale = 2;
  const geometry::Rectangle turned = geometry::bounding_box(world::prop_footprint(bench));
  EXPECT_LT((turned.max - bench.position - 2 * Vector2d(half.y(), half.x())).norm(), 1e-9);
  EXPECT_GT(geometry::signed_area(world::prop_footprint(bench)), 0) << "counter-clockwise";
}

TEST(Outward, IsAwayFromTheMiddle) {
  const world::Rectangle inside{{0, 0}, {10, 10}};
  for (const auto& [from, to, out] :
       {std::tuple(Vector2d(0, 2), Vector2d(0, 4), Vector2d(-1, 0)),
        std::tuple(Vector2d(0, 4), Vector2d(0, 2), Vector2d(-1, 0)),
        std::tuple(Vector2d(3, 10), Vector2d(6, 10), Vector2d(0, 1)),
        std::tuple(Vector2d(10, 1), Vector2d(10, 2), Vector2d(1, 0))}) {
    EXPECT_LT((outward_direction({from, to, 1}, inside) - out).norm(), 1e-12);
  }
}

struct Written {
  json scenario;
  json job;
  std::string scene;
  std::string behavior;
  std::string skipped;
};

Written written(const ImportedScenario& scenario, const Population& population) {
  const throng::testing::TemporaryFolder folder;
  const auto file = write_imported_scenario(scenario, population, folder.path());
  EXPECT_EQ(file.filename(), scenario.name + ".json");
  const auto text = [&](const char* suffix) {
    return read_file(folder.path() / (scenario.name + suffix));
  };
  return {json::parse(text(".json")), json::parse(text(".job.json")), text("_scene.xml"),
          text("_behavior.xml"), text(".skipped.txt")};
}

std::size_t count_occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

TEST(WriteImportedScenario, HasExitsBuildingsAndPeople) {
  ImportedScenario scenario = field();
  scenario.gates = {{{0, 8}, {0, 12.00049}, 1}, {{40, 8}, {40, 12}, 3}};
  scenario.people_come = true;
  scenario.skipped.push_back({"w.sdf", 7, "model a", "lost"});
  const Population population = populate(scenario, {20, 1});
  const Written files = written(scenario, population);
  EXPECT_EQ(files.scenario.at("name"), "field");
  ASSERT_EQ(files.scenario.at("exits").size(), 2);
  EXPECT_EQ(files.scenario.at("exits")[0].at("to"), json({0, 12}));
  EXPECT_EQ(files.scenario.at("exits")[0].at("outward"), json({-1, 0}));
  EXPECT_EQ(files.scenario.at("exits")[1].at("goals"), json({{0, 1}}));
  EXPECT_EQ(files.scenario.at("buildings")[0].at("height_m"), 6);
  EXPECT_EQ(files.scenario.at("inside").at("max"), json({40, 20}));
  EXPECT_EQ(files.scenario.at("ground").at("min"), json({-12, -12})) << "12 m beyond";
  EXPECT_EQ(files.job.at("scenario"), "field");
  EXPECT_EQ(count_occurrences(files.scene, "<Arrivals"), 2);
  // 20 people, 40 m at 1.34 m/s: 20 / 29.85 s = 0.67 per second, shared 1 to 3.
  EXPECT_THAT(files.scene, HasSubstr("per_second=\"0.1675\""));
  EXPECT_THAT(files.scene, HasSubstr("per_second=\"0.5025\""));
  EXPECT_EQ(count_occurrences(files.behavior, "<Goal "), 2);
  EXPECT_THAT(files.skipped, HasSubstr("w.sdf:7: model a: lost\n"));
}

TEST(WriteImportedScenario, PutsTheDroneAboveRoofs) {
  ImportedScenario scenario = field();
  const auto height_of = [&](double building_m) {
    scenario.buildings[0].height_m = building_m;
    ImportedScenario copy = scenario;
    const Population population = populate(copy, {1, 1});
    return written(copy, population).scenario.at("drones")[0].at("start")[2].get<double>();
  };
  EXPECT_NEAR(height_of(6), 18, 1e-9) << "0.45 of 40 m";
  EXPECT_NEAR(height_of(30), 36, 1e-9) << "6 m above";
}

TEST(SkippedText, HasFileLineElementAndReason) {
  EXPECT_EQ((Skipped{"w.sdf", 12, "model box <plugin>", "is not run"}).text(),
            "w.sdf:12: model box <plugin>: is not run");
  EXPECT_EQ((Skipped{"m.osm", 0, "way 3", "is gone"}).text(), "m.osm: way 3: is gone");
  EXPECT_EQ((Skipped{"", 0, "people", "no room"}).text(), "people: no room");
}

TEST(PlaceNames, AreLowerCaseWords) {
  EXPECT_EQ(scenario_name_from("/x/A--b__C.sdf"), "a_b_c");
  EXPECT_EQ(scenario_name_from("__9 lives!.osm"), "9_lives");
  EXPECT_EQ(scenario_name_from("!!!"), "scenario");
  EXPECT_EQ(scenario_name_from(""), "scenario");
}

}  // namespace
}  // namespace throng::imports
