// The estimate of a counting camera against the truth.
#include "sim/sensors/perception.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/sim/yard.h"
#include "tests/world/temporary_folder.h"

namespace throng::sim {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kOwnDrone = 0;

WorldView truth_at(double time_s, std::vector<PersonSeen> people) {
  WorldView view;
  view.time_s = time_s;
  view.people = std::move(people);
  view.exit_flow_per_s = {0, 0};
  view.drones = {{{0, 0, 10}, {0, 0, 0}, false, {}}};
  return view;
}

TEST(Perception, ACameraSeesItsConeOnly) {
  const world::Scenario scenario = testing::yard();
  const PerceptionSpec spec{PerceptionKind::camera, EIGEN_PI / 2, 0, 0};
  CameraPerception camera(scenario, spec, 1, kOwnDrone);
  const WorldView seen = camera.estimate(truth_at(0, {{{9, 0}, {0, 0}, 0}, {{11, 0}, {0, 0}, 0}}));
  ASSERT_EQ(seen.people.size(), 1U) << "10 m up, 45 degrees to each side";
  EXPECT_LT((seen.people[0].position - Vector2d(9, 0)).norm(), 1.5);
}

TEST(Perception, EstimatesAreLate) {
  const world::Scenario scenario = testing::yard();
  const PerceptionSpec spec{PerceptionKind::camera, EIGEN_PI / 2, 1, 0};
  CameraPerception camera(scenario, spec, 1, kOwnDrone);
  std::size_t first_seen = 0;
  for (std::size_t step = 0; step < 30 && first_seen == 0; ++step) {
    std::vector<PersonSeen> people;
    if (step >= 5) people.push_back({{0, 0}, {0, 0}, 0});
    if (!camera.estimate(truth_at(0.1 * static_cast<double>(step), people)).people.empty()) {
      first_seen = step;
    }
  }
  EXPECT_EQ(first_seen, 15U) << "1 s after they came";
}

TEST(Perception, CountsAreNoisyButRightOnAverageAndRepeatable) {
  const world::Scenario scenario = testing::yard();
  const PerceptionSpec spec{PerceptionKind::camera, EIGEN_PI / 2, 0, 0.1};
  const auto people = testing::people_about({0, 0}, 50, 0);
  const auto counts = [&](std::uint64_t seed) {
    CameraPerception camera(scenario, spec, seed, kOwnDrone);
    std::vector<std::size_t> result;
    for (int i = 0; i < 400; ++i) {
      result.push_back(camera.estimate(truth_at(0.1 * i, people)).people.size());
    }
    return result;
  };
  const auto once = counts(1);
  double sum = 0;
  for (const std::size_t count : once) sum += static_cast<double>(count);
  // Each person adds a variance of 0.2: the mean of 400 looks has a deviation of 0.16.
  EXPECT_NEAR(sum / 400, 50, 0.6);
  EXPECT_GT(std::count_if(once.begin(), once.end(), [](std::size_t n) { return n != 50; }), 200);
  EXPECT_EQ(once, counts(1));
  EXPECT_NE(once, counts(2));
}

TEST(Perception, GuessesTheExitFromTheMotion) {
  const world::Scenario scenario = testing::yard();
  const PerceptionSpec spec{PerceptionKind::camera, EIGEN_PI / 2, 0, 0};
  CameraPerception camera(scenario, spec, 1, kOwnDrone);
  const WorldView seen = camera.estimate(
      truth_at(0, {{{3, 2}, {-1.5, 0}, 1}, {{-3, -2}, {1.5, 0}, 0}, {{5, 5}, {0, 0}, 0}}));
  ASSERT_EQ(seen.people.size(), 3U);
  EXPECT_EQ(seen.people[0].exit, 0) << "runs to the left, whatever is in its mind";
  EXPECT_EQ(seen.people[1].exit, 1);
  EXPECT_EQ(seen.people[2].exit, 1) << "stands: the nearest";
}

TEST(TheTruth, HoldsStandingPeopleWithoutCasualties) {
  const throng::testing::TemporaryFolder folder;
  const auto group = [](const char* state, double x) {
    return fmt::format(R"(<AgentGroup><ProfileSelector type="const" name="a"/>
        <StateSelector type="const" name="{}"/>
        <Generator type="explicit"><Agent p_x="{}" p_y="0"/></Generator></AgentGroup>)",
                       state, x);
  };
  folder.write("scene.xml", R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/>
      <Common time_step="0.1"/><AgentProfile name="a"><Common r="0.2"/></AgentProfile>)" +
                                group("Stand", 1) + group("Casualty", 3) + "</Experiment>");
  folder.write("behavior.xml", R"(<BFSM>
      <State name="Stand" final="1"><GoalSelector type="identity"/><VelComponent type="zero"/></State>
      <State name="Casualty" final="1"><GoalSelector type="identity"/><VelComponent type="zero"/>
      </State></BFSM>)");
  world::Scenario scenario = testing::yard();
  scenario.scene_file = folder.path() / "scene.xml";
  scenario.behavior_file = folder.path() / "behavior.xml";
  crowd::Simulation people = load_people(scenario, 1, {});
  people.prepare_to_step();
  const auto crowd = simulated(std::move(people));
  const std::vector<world::AgentRole> roles(2, world::AgentRole::person);
  const std::vector<world::GoalRef> moving;
  const std::vector<std::optional<world::GoalRef>> guides;
  CrowdRecorder recorder(scenario, roles, moving, 1);
  CrowdObserver observer(scenario, roles, guides, crowd->dt_s());
  RunObserver nobody;
  recorder.record(*crowd, 0, nobody);
  observer.look(*crowd, recorder, 0);
  ASSERT_EQ(observer.view().people.size(), 1U);
  EXPECT_NEAR(observer.view().people[0].position.x(), 1, 1e-6);
  EXPECT_EQ(crowd->now().flags,
            (std::vector<std::uint8_t>{world::kPresent, world::kPresent | world::kFallen}))
      << "the trace says who lies";
}

}  // namespace
}  // namespace throng::sim
