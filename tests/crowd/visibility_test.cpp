// The option test_visibility: walls hide neighbors.
#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"
#include "tests/crowd/navigation_files.h"

namespace throng::crowd {
namespace {

const std::string kStand = R"(<BFSM><State name="Start" final="0"/></BFSM>)";
/// Thin, along the x axis, from -5 to 5 m.
const std::vector<Box> kWall = {{{-5, -0.02F}, {5, 0.02F}}};

/// How somebody stands aside in a step for others, who are at these places, in m/s.
Eigen::Vector2f yielding(const std::string& others, int test_visibility, const std::string& model,
                         const std::string& obstacle_set = "1") {
  std::string scene =
      test::scene_with(test::agent_at(0, 0.35) + others,
                       R"(r="0.3" max_accel="100" obstacleSet=")" + obstacle_set + "\"", "Start",
                       test::obstacles(kWall));
  const std::string query = R"(type="kd-tree")";
  scene.replace(scene.find(query), query.size(),
                fmt::format(R"({} test_visibility="{}")", query, test_visibility));
  Simulation crowd = test::load(scene, kStand, {.model = model});
  crowd.step();
  return crowd.velocities()[0];
}

class Visibility : public testing::TestWithParam<std::string> {};

TEST_P(Visibility, WallsHideNeighborsIfAsked) {
  const std::string& model = GetParam();
  const std::string behind = test::agent_at(0, -0.2);
  const std::string beside = test::agent_at(0.5, 0.35);
  const Eigen::Vector2f alone = yielding("", 1, model);
  EXPECT_EQ(yielding(behind, 1, model), alone);
  EXPECT_NE(yielding(behind, 0, model), alone) << "by default one feels them through walls";
  EXPECT_NE(yielding(beside, 1, model), alone) << "who stands on the same side is seen";
  EXPECT_EQ(yielding(beside + behind, 1, model), yielding(beside, 1, model));
  EXPECT_NE(yielding(behind, 1, model, "2"), yielding("", 1, model, "2"))
      << "walls of classes that one does not mind hide nobody";
}

INSTANTIATE_TEST_SUITE_P(Models, Visibility, testing::Values("orca", "pedvo", "helbing"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace throng::crowd
