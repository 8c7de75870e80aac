// Gazebo's worlds: what becomes of each shape, where it is, and what is listed as skipped.
#include "imports/sdf_world.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "tests/world/temporary_folder.h"
#include "world/polygon.h"

namespace throng::imports {
namespace {

using throng::testing::TemporaryFolder;

const std::filesystem::path kWorlds =
    std::filesystem::path(THRONG_SOURCE_DIR) / "tests/imports/data";

Place yard() { return read_sdf(kWorlds / "yard.sdf", {{kWorlds / "models"}, {}}); }

bool is_blocked(const Place& place, const Eigen::Vector2d& point) {
  return std::any_of(place.obstacles.begin(), place.obstacles.end(), [&](const Corners& obstacle) {
    return world::distance_to(obstacle, point) == 0;
  });
}

const Skipped* skipped_with(const Place& place, const std::string& words) {
  for (const Skipped& one : place.skipped) {
    if (one.text().find(words) != std::string::npos) return &one;
  }
  return nullptr;
}

TEST(Sdf, TallUprightBodiesAreBuildingsWhereTheirPosesSay) {
  const Place place = yard();
  ASSERT_EQ(place.buildings.size(), 3U);
  EXPECT_NEAR(place.buildings[0].height_m, 6, 1e-6);  // the hall, relative to a frame
  EXPECT_EQ(world::distance_to(place.buildings[0].footprint, {15, 10}), 0);
  EXPECT_GT(world::distance_to(place.buildings[0].footprint, {20.5, 10}), 0.4);
  // The tower in it is turned: 2 m along x, 4 m along y, at (15, 10) - (15, 20).
  const auto tower = std::find_if(place.buildings.begin(), place.buildings.end(),
                                  [](const world::Building& b) { return b.height_m > 7; });
  ASSERT_NE(tower, place.buildings.end());
  EXPECT_NEAR(tower->height_m, 8, 1e-6);
  EXPECT_EQ(world::distance_to(tower->footprint, {0.9, -8.1}), 0);
  EXPECT_NEAR(world::distance_to(tower->footprint, {1.5, -10}), 0.5, 1e-6);
}

TEST(Sdf, PeopleWalkAroundWhatIsLowAndBelowWhatIsHigh) {
  const Place place = yard();
  EXPECT_TRUE(is_blocked(place, {15, 10}));
  EXPECT_TRUE(is_blocked(place, {-15, -12}));
  EXPECT_TRUE(is_blocked(place, {3.9, 2.4}));  // the kiosk of the included model
  EXPECT_TRUE(is_blocked(place, {0, -4}));     // the log that lies
  EXPECT_FALSE(is_blocked(place, {-8, 14}));   // the bridge
  ASSERT_EQ(place.things.size(), 3U);
  const auto kiosk = std::find_if(place.things.begin(), place.things.end(),
                                  [](const Thing& thing) { return thing.name == "kiosk"; });
  ASSERT_NE(kiosk, place.things.end());
  EXPECT_NEAR(kiosk->solids.at(0).rgb.x(), 0.8, 1e-6);
  EXPECT_EQ(place.areas.at(0).material, "grass");
  ASSERT_EQ(place.props.size(), 1U);
  EXPECT_EQ(place.props[0].kind, world::PropKind::lamp_post);
}

TEST(Sdf, WhatItDoesNotTakeIsListedWithItsLine) {
  const Place place = yard();
  for (const char* words : {"<plugin>", "<physics>", "<sensor>", "world/sun", "nowhere"}) {
    const Skipped* skipped = skipped_with(place, words);
    ASSERT_NE(skipped, nullptr) << words;
    if (std::string(words) == "<plugin>") {
      EXPECT_EQ(skipped->line, 5);
    }
  }
}

TEST(Sdf, RefusesWhatIsNoWorldAndSkipsWhatCannotBe) {
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
    const Place place = read(world_with(geometry));
    EXPECT_TRUE(place.buildings.empty() && place.things.empty()) << geometry;
    EXPECT_FALSE(place.skipped.empty()) << geometry;
  }
}

TEST(Sdf, AModelThatIncludesItselfEnds) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "m/model.config",
                        "<model><name>m</name><sdf version='1.7'>model.sdf</sdf></model>");
  write_file_atomically(folder.path() / "m/model.sdf",
                        "<sdf version='1.7'><model name='m'><include><uri>model://m</uri></include>"
                        "</model></sdf>");
  write_file_atomically(folder.path() / "w.sdf",
                        "<sdf version='1.7'><world name='w'><include><uri>model://m</uri></include>"
                        "</world></sdf>");
  try {
    EXPECT_TRUE(read_sdf(folder.path() / "w.sdf", {}).buildings.empty());
  } catch (const InputError&) {  // as good
  }
}

}  // namespace
}  // namespace throng::imports
