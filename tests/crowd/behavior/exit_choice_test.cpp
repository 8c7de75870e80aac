// The goal selector exit_choice.
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

/// A wall from y = -20 to 20 between x and x + 0.5, with a door of 0.8 m in the middle.
std::string wall_with_door(double x) {
  std::string obstacles;
  for (const auto& [low, high] : {std::pair(-20.0, -0.4), std::pair(0.4, 20.0)}) {
    obstacles += fmt::format(
        R"(<Obstacle closed="1"><Vertex p_x="{0}" p_y="{2}"/><Vertex p_x="{1}" p_y="{2}"/>
           <Vertex p_x="{1}" p_y="{3}"/><Vertex p_x="{0}" p_y="{3}"/></Obstacle>)",
        x, x + 0.5, low, high);
  }
  return obstacles;
}

/// A crowd near the left one of two exits, 30 m apart.
std::string crowd_at_the_left(int columns) {
  return fmt::format(R"(<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
  <AgentProfile name="a"><Common r="0.2" max_speed="2" max_accel="5"/></AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="a"/><StateSelector type="const" name="Run"/>
    <Generator type="rect_grid" anchor_x="2" anchor_y="-4.5" offset_x="1" offset_y="1"
               count_x="{}" count_y="10"/>
  </AgentGroup>
  <ObstacleSet type="explicit" class="1">{}{}</ObstacleSet>
</Experiment>)",
                     columns, wall_with_door(0.2), wall_with_door(29.3));
}

std::string choosing(const std::string& attributes) {
  return fmt::format(R"(<BFSM>
  <GoalSet id="0"><Goal id="0" type="point" x="0" y="0"/><Goal id="1" type="point" x="30" y="0"/>
  </GoalSet>
  <State name="Run" final="0"><GoalSelector type="exit_choice" goal_set="0" {}/>
    <VelComponent type="goal"/></State>
  <State name="Gone" final="1"><Action type="leave"/></State>
  <Transition from="Run" to="Gone"><Condition type="goal_reached" distance="0.3"/></Transition>
</BFSM>)",
                     attributes);
}

std::array<int, 2> headed_for(const Simulation& crowd) {
  std::array<int, 2> counts{};
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    if (crowd.present()[i] != 0) ++counts[crowd.goals()[i].goal];
  }
  return counts;
}

double time_to_empty_s(const std::string& attributes) {
  Simulation crowd = test::load(crowd_at_the_left(10), choosing(attributes));
  while (!crowd.all_final() && crowd.time_s() < 200) crowd.step();
  return crowd.time_s();
}

TEST(ExitChoice, TakesTheNearestWhenThereIsNoQueue) {
  const Simulation crowd = test::load(crowd_at_the_left(1), choosing(""));
  EXPECT_EQ(headed_for(crowd)[1], 0);
}

TEST(ExitChoice, AvoidsALongQueueOnceItIsSeen) {
  Simulation crowd = test::load(crowd_at_the_left(10), choosing(R"(flow="1")"));
  EXPECT_EQ(headed_for(crowd)[1], 0);  // nobody has a goal yet, so there is no queue
  while (crowd.time_s() < 4) crowd.step();
  EXPECT_GT(headed_for(crowd)[1], 20);
  EXPECT_GT(headed_for(crowd)[0], 20);
}

TEST(ExitChoice, NobodyReconsidersUnlessAllowedTo) {
  Simulation crowd = test::load(crowd_at_the_left(10), choosing(R"(flow="1" reconsider="0")"));
  while (crowd.time_s() < 6) crowd.step();
  EXPECT_EQ(headed_for(crowd)[1], 0);
}

TEST(ExitChoice, AWiderExitDrainsItsQueueFaster) {
  std::string wide = choosing(R"(flow="1")");
  wide.replace(wide.find("y=\"0\"/>"), 8, "y=\"0\" weight=\"50\"/>");
  Simulation crowd = test::load(crowd_at_the_left(10), wide);
  while (crowd.time_s() < 4) crowd.step();
  EXPECT_LT(headed_for(crowd)[1], 10);
}

TEST(ExitChoice, AgentsThatDoNotKnowTheOtherExitStay) {
  Simulation unfamiliar =
      test::load(crowd_at_the_left(10), choosing(R"(flow="1" familiarity="0" sight="5")"));
  Simulation half =
      test::load(crowd_at_the_left(10), choosing(R"(flow="1" familiarity="0.5" sight="5")"));
  Simulation familiar =
      test::load(crowd_at_the_left(10), choosing(R"(flow="1" familiarity="1" sight="5")"));
  for (Simulation* crowd : {&unfamiliar, &half, &familiar}) {
    while (crowd->time_s() < 4) crowd->step();
  }
  EXPECT_EQ(headed_for(unfamiliar)[1], 0);
  EXPECT_GT(headed_for(half)[1], 0);
  EXPECT_LT(headed_for(half)[1], headed_for(familiar)[1]);
}

TEST(ExitChoice, EmptiesThePlaceSooner) {
  const double with_choice_s = time_to_empty_s("");
  EXPECT_LT(with_choice_s, 0.85 * time_to_empty_s(R"(reconsider="0")"));
  RecordProperty("empty_s", std::to_string(with_choice_s));
}

}  // namespace
}  // namespace throng::crowd
