// Worlds that Gazebo saved: the poses and scales of their <state>, which are in the world's frame.
#include <gtest/gtest.h>

#include "tests/places/imports/gazebo/world_text.h"

namespace throng::imports {
namespace {

using Eigen::Vector2d;
using imports_testing::box_model;
using imports_testing::building_at;
using imports_testing::is_listed;
using imports_testing::read_world_text;

TEST(SavedStates, PlaceTheirModels) {
  const ImportedScenario scenario = read_world_text(
      box_model("a", 6, 4, 3, "5 5 0 0 0 0") + box_model("b", 2, 2, 3, "20 0 0 0 0 0") +
      "<state world_name='w'><sim_time>0 0</sim_time><model name='a'>"
      "<pose frame=''>-12 -9 0 0 -0 1.5707963</pose><scale>1 1 1</scale></model></state>");
  ASSERT_EQ(scenario.buildings.size(), 2);
  const geometry::Rectangle bounds = geometry::bounding_box(scenario.buildings[0].footprint);
  EXPECT_LT((bounds.min - Vector2d(-14, -12)).norm(), 1e-5) << "turned: 4 m along x, 6 m along y";
  EXPECT_LT((bounds.max - Vector2d(-10, -6)).norm(), 1e-5);
  EXPECT_NE(building_at(scenario, {20, 0}), nullptr) << "without a state";
  EXPECT_TRUE(scenario.skipped.empty());
}

TEST(SavedStates, PlaceLinksAndNestedModelsInTheWorld) {
  const std::string nested = "<model name='outer'><static>1</static>" +
                             box_model("inner", 2, 2, 4, "1 0 0 0 0 0") + "</model>";
  const ImportedScenario scenario = read_world_text(
      box_model("a", 2, 2, 3) + nested +
          "<state world_name='w'><model name='a'><pose>30 0 0 0 0 0</pose><link name='l'>"
          "<pose>10 5 1.5 0 0 0</pose></link></model><model name='outer'><pose>0 20 0 0 0 0</pose>"
          "<model name='inner'><pose>-8 -8 0 0 0 0</pose></model></model></state>",
      "1.7");
  EXPECT_NE(building_at(scenario, {10, 5}), nullptr);
  EXPECT_NE(building_at(scenario, {-8, -8}), nullptr);
  EXPECT_EQ(scenario.buildings.size(), 2);
}

TEST(SavedStates, ScaleTheirModels) {
  const std::string cylinder =
      "<model name='c'><static>1</static><link name='l'><pose>0 0 3 0 0 0</pose><visual name='v'>"
      "<geometry><cylinder><radius>1</radius><length>6</length></cylinder></geometry></visual>"
      "</link></model>";
  const ImportedScenario scenario = read_world_text(
      box_model("a", 6, 4, 3, "5 5 0 0 0 0") + cylinder +
      "<state world_name='w'><model name='a'><scale>2 1 1</scale></model><model name='c'>"
      "<pose>-20 0 0 0 0 0</pose><scale>3 3 1</scale></model></state>");
  const auto* box = building_at(scenario, {5, 5});
  ASSERT_NE(box, nullptr);
  const geometry::Rectangle bounds = geometry::bounding_box(box->footprint);
  EXPECT_LT((bounds.max - bounds.min - Vector2d(12, 4)).norm(), 1e-6);
  EXPECT_NEAR(box->height_m, 3, 1e-6);
  EXPECT_NE(building_at(scenario, {-20, 2.9}), nullptr) << "a radius of 3 m";
  EXPECT_EQ(building_at(scenario, {-20, 3.1}), nullptr);
}

TEST(SavedStates, ListModelsThatAreDeletedInsertedOrUnknown) {
  const ImportedScenario scenario =
      read_world_text(box_model("a", 4, 4, 3) + box_model("gone", 4, 4, 3, "20 0 0 0 0 0") +
                      "<state world_name='w'><deletions><name>gone</name></deletions><insertions>" +
                      box_model("new", 4, 4, 3) +
                      "</insertions><model name='other'><pose>1 2 3 0 0 0</pose></model>"
                      "<model name='a'><pose>1e9 0 0 0 0 0</pose></model></state>");
  EXPECT_EQ(scenario.buildings.size(), 1);
  EXPECT_NE(building_at(scenario, {0, 0}), nullptr) << "5 km is the farthest";
  EXPECT_TRUE(is_listed(scenario, "gone: deleted by the world's <state>"));
  EXPECT_TRUE(is_listed(scenario, "model new <insertions>"));
  EXPECT_TRUE(is_listed(scenario, "model other <state>: the world has no model of this name"));
  EXPECT_TRUE(is_listed(scenario, "a/<pose>"));
}

TEST(SavedStates, PlaceLights) {
  const ImportedScenario scenario = read_world_text(
      box_model("a", 4, 4, 3) +
      "<light name='lamp' type='point'><pose>0 0 5 0 0 0</pose></light><state world_name='w'>"
      "<light name='lamp'><pose>12 -3 4 0 0 0</pose></light></state>");
  ASSERT_EQ(scenario.props.size(), 1);
  EXPECT_LT((scenario.props[0].position - Vector2d(12, -3)).norm(), 1e-9);
}

}  // namespace
}  // namespace throng::imports
