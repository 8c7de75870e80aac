// Gazebo's worlds: what becomes of each shape, where it is, and what is listed as skipped.
#include "base/files/resources.h"
#include "places/imports/gazebo/sdf_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "places/imports/parts/populate.h"
#include "places/imports/parts/scenario_writer.h"
#include "spec/job/environment.h"
#include "tests/world/temporary_folder.h"

namespace throng::imports {
namespace {

using throng::testing::TemporaryFolder;

const std::filesystem::path kWorlds = source_folder() / "tests/places/imports/data";

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
  for (const char* words : {"<plugin>", "<physics>", "<sensor>", "nowhere"}) {
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
  EXPECT_EQ(skipped_with(scenario, "no file for"), nullptr);
  // Its motors lie one model below, its links two.
  ASSERT_EQ(scenario.drones.size(), 1U);
  EXPECT_EQ(scenario.drones[0].robot_file.filename(), "model.sdf");
}

TEST(Sdf, RobotsBecomeDronesWhereTheyStand) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "w.sdf",
                        "<sdf version='1.9'><world name='w'><include><name>scout 1</name>"
                        "<uri>model://racer</uri><pose>4 -3 0.2 0 0 1.2</pose></include><include>"
                        "<name>scout 2</name><uri>model://racer</uri><pose>1 2 7 0 0 0</pose>"
                        "</include></world></sdf>");
  const ImportedScenario scenario = read_sdf(folder.path() / "w.sdf", {{kWorlds / "robots"}, {}});
  ASSERT_EQ(scenario.drones.size(), 2U);
  EXPECT_TRUE(scenario.objects.empty());  // robots fly, and are no scenery
  EXPECT_EQ(scenario.drones[0].id, "scout_1");
  EXPECT_EQ(scenario.drones[0].position.head<2>(), Eigen::Vector2d(4, -3));
  EXPECT_NEAR(scenario.drones[0].yaw_rad, 1.2, 1e-9);
  EXPECT_EQ(scenario.drones[0].position.z(), overview_height_m(scenario));  // it stood
  EXPECT_NE(skipped_with(scenario, "robot scout_1: stands at 0.20 m"), nullptr);
  EXPECT_NEAR(scenario.drones[1].position.z(), 7, 1e-9);
}

TEST(Sdf, CamerasOfTheWorldHoverWhereTheyAre) {
  const auto camera = [](const std::string& pose, const std::string& width) {
    return "<model name='post'><static>1</static><pose>" + pose +
           "</pose><link name='l'><sensor name='view' type='camera'><pose>0 0 0 0 0.5 0</pose>"
           "<camera><horizontal_fov>1.2</horizontal_fov><image><width>" +
           width +
           "</width><height>480</height></image></camera></sensor>"
           "<sensor name='beam' type='gpu_lidar'/></link></model>";
  };
  const TemporaryFolder folder;
  const auto read = [&](const std::string& models) {
    write_file_atomically(folder.path() / "w.sdf",
                          "<sdf version='1.9'><world name='w'>" + models + "</world></sdf>");
    return read_sdf(folder.path() / "w.sdf", {});
  };
  const ImportedScenario scenario = read(camera("3 4 6 0 0 0.7", "640"));
  ASSERT_EQ(scenario.drones.size(), 1U);
  const ImportedDrone& drone = scenario.drones[0];
  EXPECT_EQ(drone.id, "view");
  EXPECT_NEAR((drone.position - Eigen::Vector3d(3, 4, 6)).norm(), 0, 1e-9);
  EXPECT_NEAR(drone.yaw_rad, 0.7, 1e-9);
  EXPECT_NEAR(drone.camera["pitch_deg"].get<double>(), -28.65, 1e-9);
  EXPECT_EQ(drone.camera["width"], 640);
  EXPECT_NE(skipped_with(scenario, "beam <sensor>"), nullptr);
  EXPECT_TRUE(read(camera("3 4 6 0 0 0.7", "16")).drones.empty());   // too few pixels
  EXPECT_TRUE(read(camera("3 4 0.2 0 0 0", "640")).drones.empty());  // on the ground
  const std::string tower =
      "<model name='tower'><static>1</static><pose>3 5.5 5 0 0 0</pose><link name='l'><visual "
      "name='v'><geometry><box><size>2 2 10</size></box></geometry></visual></link></model>";
  const ImportedScenario walled = read(tower + camera("3 4 6 0 0 0.7", "640"));
  EXPECT_TRUE(walled.drones.empty());
  EXPECT_NE(skipped_with(walled, "camera view: less than 1 m from a building"), nullptr);
}

TEST(Sdf, TheFirstDirectionalLightIsTheSun) {
  const auto environment = [](const std::string& light, const std::string& more = "") {
    const TemporaryFolder folder;
    write_file_atomically(folder.path() / "w.sdf",
                          "<sdf version='1.9'><world name='w'>" + more +
                              "<light name='sun' type='directional'><direction>" + light +
                              "</direction></light></world></sdf>");
    return read_sdf(folder.path() / "w.sdf", {}).environment;
  };
  const auto angle_deg = [](const nlohmann::ordered_json& found, const Eigen::Vector3d& shines) {
    const std::string time = found.at("time_of_day");
    const jobs::Sun sun =
        jobs::sun_at(std::stod(time.substr(0, 2)) + std::stod(time.substr(3)) / 60,
                     found.at("latitude_deg"), found.at("day_of_year"));
    const Eigen::Vector3d towards(std::cos(sun.elevation_rad) * std::cos(sun.azimuth_rad),
                                  std::cos(sun.elevation_rad) * std::sin(sun.azimuth_rad),
                                  std::sin(sun.elevation_rad));
    return std::acos(towards.dot(-shines.normalized())) / kDegree;
  };
  const std::string zurich =
      "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>"
      "<latitude_deg>47.4</latitude_deg><longitude_deg>8.5</longitude_deg><elevation>0</elevation>"
      "</spherical_coordinates>";
  const auto noon = environment("0.001 0.625 -0.78", zurich);  // that of PX4's worlds
  EXPECT_EQ(noon.at("latitude_deg"), 47.4);
  EXPECT_LT(angle_deg(noon, {0.001, 0.625, -0.78}), 1);
  const auto morning = environment("-1 0.2 -0.6");
  EXPECT_LT(angle_deg(morning, {-1, 0.2, -0.6}), 1);
  EXPECT_LT(morning.at("time_of_day").get<std::string>(), "12:00");
  EXPECT_TRUE(environment("0 0 1").is_null());  // from below
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
