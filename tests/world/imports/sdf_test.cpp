// Gazebo's worlds: what becomes of each shape, where it is, and what is listed as skipped.
#include "base/files/resources.h"
#include "world/imports/gazebo/sdf_world.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/polygon.h"
#include "tests/world/temporary_folder.h"
#include "world/imports/parts/populate.h"

namespace throng::imports {
namespace {

using throng::testing::TemporaryFolder;

const std::filesystem::path kWorlds = source_folder() / "tests/world/imports/data";

ImportedScenario yard() { return read_sdf(kWorlds / "yard.sdf", {{kWorlds / "models"}, {}}); }

bool is_blocked(const ImportedScenario& scenario, const Eigen::Vector2d& point) {
  return std::any_of(
      scenario.obstacles.begin(), scenario.obstacles.end(),
      [&](const Corners& obstacle) { return geometry::distance_to(obstacle, point) == 0; });
}

const Skipped* skipped_with(const ImportedScenario& scenario, const std::string& words) {
  for (const Skipped& one : scenario.skipped) {
    if (one.text().find(words) != std::string::npos) return &one;
  }
  return nullptr;
}

TEST(Sdf, TallUprightBodiesAreBuildingsWhereTheirPosesSay) {
  const ImportedScenario scenario = yard();
  ASSERT_EQ(scenario.buildings.size(), 3U);
  EXPECT_NEAR(scenario.buildings[0].height_m, 6, 1e-6);  // the hall, relative to a frame
  EXPECT_EQ(geometry::distance_to(scenario.buildings[0].footprint, {15, 10}), 0);
  EXPECT_GT(geometry::distance_to(scenario.buildings[0].footprint, {20.5, 10}), 0.4);
  // The tower in it is turned: 2 m along x, 4 m along y, at (15, 10) - (15, 20).
  const auto tower = std::find_if(scenario.buildings.begin(), scenario.buildings.end(),
                                  [](const world::Building& b) { return b.height_m > 7; });
  ASSERT_NE(tower, scenario.buildings.end());
  EXPECT_NEAR(tower->height_m, 8, 1e-6);
  EXPECT_EQ(geometry::distance_to(tower->footprint, {0.9, -8.1}), 0);
  EXPECT_NEAR(geometry::distance_to(tower->footprint, {1.5, -10}), 0.5, 1e-6);
}

TEST(Sdf, PeopleWalkAroundLowObjectsAndBelowHighOnes) {
  const ImportedScenario scenario = yard();
  EXPECT_TRUE(is_blocked(scenario, {15, 10}));
  EXPECT_TRUE(is_blocked(scenario, {-15, -12}));
  EXPECT_TRUE(is_blocked(scenario, {3.9, 2.4}));  // the kiosk of the included model
  EXPECT_TRUE(is_blocked(scenario, {0, -4}));     // the log that lies
  EXPECT_FALSE(is_blocked(scenario, {-8, 14}));   // the bridge
  ASSERT_EQ(scenario.objects.size(), 3U);
  const auto kiosk = std::find_if(scenario.objects.begin(), scenario.objects.end(),
                                  [](const Object& object) { return object.name == "kiosk"; });
  ASSERT_NE(kiosk, scenario.objects.end());
  EXPECT_NEAR(kiosk->solids.at(0).rgb.x(), 0.8, 1e-6);
  EXPECT_EQ(scenario.areas.at(0).material, "grass");
  ASSERT_EQ(scenario.props.size(), 1U);
  EXPECT_EQ(scenario.props[0].kind, world::PropKind::lamp_post);
}

TEST(Sdf, SkippedElementsAreListedWithTheirLine) {
  const ImportedScenario scenario = yard();
  for (const char* words : {"<plugin>", "<physics>", "<sensor>", "world/sun", "nowhere"}) {
    const Skipped* skipped = skipped_with(scenario, words);
    ASSERT_NE(skipped, nullptr) << words;
    if (std::string(words) == "<plugin>") {
      EXPECT_EQ(skipped->line, 5);
    }
  }
}

TEST(Sdf, RefusesOtherFilesAndSkipsImpossibleElements) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    write_file_atomically(folder.path() / "w.sdf", text);
    return read_sdf(folder.path() / "w.sdf", {});
  };
  const auto world_with = [](const std::string& geometry) {
    return "<sdf version='1.7'><world name='w'><model name='m'><static>1</static><link name='l'>"
           "<visual name='v'><geometry>" +
           geometry + "</geometry></visual></link></model></world></sdf>";
  };
  EXPECT_THROW(read(""), InputError);
  EXPECT_THROW(read("<sdf version='1.7'>"), InputError);
  EXPECT_THROW(read("<osm/>"), InputError);
  for (const char* geometry :
       {"<box><size>1e300 1 1</size></box>", "<box><size>-1 1 1</size></box>",
        "<sphere><radius>1e9</radius></sphere>",
        "<cylinder><radius>0</radius><length>1</length></cylinder>",
        "<mesh><uri>file:///etc/passwd</uri></mesh>", "<mesh><uri>../../etc/passwd</uri></mesh>"}) {
    const ImportedScenario scenario = read(world_with(geometry));
    EXPECT_TRUE(scenario.buildings.empty() && scenario.objects.empty()) << geometry;
    EXPECT_FALSE(scenario.skipped.empty()) << geometry;
  }
}

TEST(Sdf, AModelThatIncludesItselfIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "m/model.config",
                        "<model><name>m</name><sdf version='1.7'>model.sdf</sdf></model>");
  write_file_atomically(folder.path() / "m/model.sdf",
                        "<sdf version='1.7'>\n<model name='m'><include><uri>model://m</uri>"
                        "</include></model></sdf>");
  write_file_atomically(folder.path() / "w.sdf",
                        "<sdf version='1.7'><world name='w'><include><uri>model://m</uri></include>"
                        "</world></sdf>");
  try {
    read_sdf(folder.path() / "w.sdf", {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("m/model.sdf: line 2"), std::string::npos)
        << error.what();
  }
}

TEST(Sdf, ModelsThatIncludedModelsMergeAreFound) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "w.sdf",
                        "<sdf version='1.9'><world name='w'><include>"
                        "<uri>model://racer_with_camera</uri></include></world></sdf>");
  const ImportedScenario scenario = read_sdf(folder.path() / "w.sdf", {{kWorlds / "robots"}, {}});
  EXPECT_EQ(skipped_with(scenario, "Unable to find"), nullptr);
  ASSERT_EQ(scenario.objects.size(), 1U);  // its propeller, two models below
}

ImportedScenario parse_body(const std::string& body, const std::string& before = "",
                            const std::string& version = "1.7") {
  const TemporaryFolder folder;
  write_file_atomically(
      folder.path() / "w.world",
      before + "<sdf version='" + version + "'><world name='w'>" + body + "</world></sdf>");
  return read_sdf(folder.path() / "w.world", {});
}

std::string model_text(const std::string& name, const std::string& geometry,
                       const std::string& more = "") {
  return "<model name='" + name + "'><link name='l'><visual name='v'><geometry>" + geometry +
         "</geometry>" + more + "</visual></link></model>\n";
}

const std::string kTower = model_text("tower", "<box><size>4 4 6</size></box>");

TEST(Sdf, OneOddElementCostsOnlyItself) {
  const ImportedScenario scenario = parse_body(
      kTower + "<model name='lost'><pose>1 two 3 0 0 0</pose><link name='l'/></model>\n" +
      model_text("unsized", "<box><size>one</size></box>") + "<light name='untyped'/>\n" +
      "<model><link name='nameless'/></model>\n<include><uri>model://nowhere</uri></include>" +
      "<model name='tower'><link name='again'/></model>");
  ASSERT_EQ(scenario.buildings.size(), 1U);
  for (const auto& [words, line] :
       {std::pair("model lost", 2), std::pair("unsized/link l/visual v", 3),
        std::pair("light untyped", 4), std::pair("<model>", 5), std::pair("model://nowhere", 6)}) {
    const Skipped* skipped = skipped_with(scenario, words);
    ASSERT_NE(skipped, nullptr) << words;
    EXPECT_EQ(skipped->line, line) << words;
  }
  EXPECT_NE(skipped_with(scenario, "name[tower] already exists"), nullptr);
}

TEST(Sdf, ReadsOldNewAndUntidyFiles) {
  const std::string untidy = "<!-- by hand -->\n<?xml version='1.0' ?>\n";
  EXPECT_EQ(parse_body(kTower, untidy).buildings.size(), 1U);
  for (const char* version : {"1.3", "1.4", "1.5", "1.6", "1.9", "1.11", "1.12"}) {
    EXPECT_EQ(parse_body(kTower, "", version).buildings.size(), 1U) << version;
  }
  try {
    parse_body("<model name='m'>\n</world>");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(error.problems().front().where.find("line"), std::string::npos) << error.what();
  }
}

TEST(Sdf, KnowsPolylinesConesAndGazebosColors) {
  const ImportedScenario scenario = parse_body(
      "<model name='hall'><pose>20 0 0 0 0 0</pose><link name='l'><visual name='v'><geometry>"
      "<polyline><point>0 0</point><point>10 0</point><point>0 10</point><height>5</height>"
      "</polyline></geometry></visual></link></model>" +
      model_text("pylon", "<cone><radius>1</radius><length>1.5</length></cone>",
                 "<material><script><uri>file://media</uri><name>Gazebo/Orange</name></script>"
                 "</material>") +
      model_text("plain", "<sphere><radius>1</radius></sphere>",
                 "<material><script><uri>a</uri><name>mine</name></script></material>"));
  ASSERT_EQ(scenario.buildings.size(), 1U);
  EXPECT_NEAR(scenario.buildings[0].height_m, 5, 1e-9);
  EXPECT_EQ(geometry::distance_to(scenario.buildings[0].footprint, {22, 2}), 0);
  EXPECT_GT(geometry::distance_to(scenario.buildings[0].footprint, {27, 7}), 1);
  ASSERT_EQ(scenario.objects.size(), 2U);
  EXPECT_NEAR(scenario.objects[0].solids.at(0).rgb.y(), 0.5, 0.05);  // orange
  EXPECT_GT(scenario.objects[1].solids.at(0).rgb.minCoeff(), 0.4);   // not black
}

TEST(Sdf, ALinkWithoutItsMeshIsDrawnByItsCollisions) {
  const ImportedScenario scenario = parse_body(
      "<model name='cafe'><link name='l'><visual name='v'><geometry><mesh>"
      "<uri>model://cafe/cafe.dae</uri></mesh></geometry></visual><collision name='wall'>"
      "<pose>0 0 1.5 0 0 0</pose><geometry><box><size>8 1 3</size></box></geometry></collision>"
      "</link></model>");
  EXPECT_EQ(scenario.buildings.size(), 1U);
  EXPECT_NE(skipped_with(scenario, "drawn by its collisions"), nullptr);
}

TEST(Sdf, AClosedRoomHasGroundAroundIt) {
  std::string walls;
  for (const char* wall :
       {"0 -10 1.5 0 0 0", "0 10 1.5 0 0 0", "-10 0 1.5 0 0 1.5708", "10 0 1.5 0 0 1.5708"}) {
    walls += std::string("<collision name='c") + wall + "'><pose>" + wall +
             "</pose><geometry><box><size>20.2 0.2 3</size></box></geometry></collision>";
  }
  ImportedScenario scenario =
      parse_body("<model name='room'><link name='l'>" + walls + "</link></model>");
  EXPECT_NE(skipped_with(scenario, "walled up"), nullptr);
  EXPECT_FALSE(populate(scenario, {10, 1}).gates.empty());
  EXPECT_NE(skipped_with(scenario, "no exit can be reached from"), nullptr);
}

}  // namespace
}  // namespace throng::imports
