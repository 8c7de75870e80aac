// Errors in the files are reported with their lines, and nothing ever crashes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "base/compute/random.h"
#include "base/error.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::condition_behavior;
using test::load;
using test::mirror_behavior;
using test::scene_with;

/// The first problem of loading these files.
Problem caught_problem(const std::string& scene, const std::string& behavior) {
  try {
    load(scene, behavior);
  } catch (const InputError& error) {
    return error.problems().front();
  }
  ADD_FAILURE() << "accepted:\n" << scene << behavior;
  return {};
}

Problem behavior_problem(const std::string& behavior) {
  return caught_problem(scene_with(agent_at(0, 0)), behavior);
}

Problem condition_problem(const std::string& condition) {
  return behavior_problem(condition_behavior(condition));
}

void expect_problem(const Problem& problem, const std::string& element,
                    const std::string& attribute, const std::string& found,
                    const std::string& expected) {
  EXPECT_THAT(problem.where, testing::HasSubstr("line "));
  EXPECT_THAT(problem.where, testing::HasSubstr("element <" + element + ">"));
  if (!attribute.empty()) {
    EXPECT_THAT(problem.where, testing::HasSubstr("attribute \"" + attribute + "\""));
  }
  EXPECT_THAT(problem.found, testing::HasSubstr(found));
  EXPECT_THAT(problem.expected, testing::HasSubstr(expected));
}

TEST(Errors, NameFileLineElementAndAttribute) {
  const Problem problem = behavior_problem(
      "<BFSM>\n  <State name=\"Start\" final=\"0\">\n"
      "    <GoalSelector type=\"nearest\" goal_set=\"3\"/>\n  </State>\n</BFSM>");
  EXPECT_EQ(problem.source, "behavior.xml");
  EXPECT_EQ(problem.where, "line 3, element <GoalSelector>, attribute \"goal_set\"");
  EXPECT_THAT(problem.found, testing::HasSubstr("3"));
}

TEST(Errors, InConditions) {
  expect_problem(condition_problem(R"(<Condition type="moon"/>)"), "Condition", "type", "moon",
                 "goal_reached");
  expect_problem(condition_problem("<Condition/>"), "Condition", "type", "nothing", "auto");
  expect_problem(condition_problem(R"(<Condition type="goal_reached" distance="far"/>)"),
                 "Condition", "distance", "far", "a number");
  expect_problem(condition_problem(R"(<Condition type="goal_reached" distance="-1"/>)"),
                 "Condition", "distance", "-1", "from 0");
  expect_problem(condition_problem(R"(<Condition type="goal_reached" distance="nan"/>)"),
                 "Condition", "distance", "nan", "a number");
  expect_problem(
      condition_problem(R"(<Condition type="timer" per_agent="yes" dist="c" value="1"/>)"),
      "Condition", "per_agent", "yes", "0, 1");
  expect_problem(condition_problem(R"(<Condition type="timer" per_agent="1" dist="z"/>)"),
                 "Condition", "dist", "z", "uniform");
  expect_problem(
      condition_problem(R"(<Condition type="timer" per_agent="1" dist="u" min="3" max="2"/>)"),
      "Condition", "max", "2", "from 3");
  expect_problem(condition_problem(R"(<Condition type="timer" per_agent="1"/>)"), "Condition",
                 "dist", "nothing", "constant");
  expect_problem(condition_problem(R"(<Condition type="and"><Condition type="auto"/></Condition>)"),
                 "Condition", "", "1 conditions", "2");
  expect_problem(condition_problem(R"(<Condition type="not"><State/></Condition>)"), "State", "",
                 "not known here", "<Condition>");
  expect_problem(
      condition_problem(R"(<Condition type="proximity" distance="1" agentToAvoid="1"/>)"),
      "Condition", "agentToAvoid", "1", "below 1");
  expect_problem(condition_problem(R"(<Condition type="proximity" distance="5" max_distance="4"
                                      agentToAvoid="0"/>)"),
                 "Condition", "max_distance", "4", "5");
  expect_problem(
      condition_problem(R"(<Condition type="follow" distance="1" goalSetToFollow="9"/>)"),
      "Condition", "goalSetToFollow", "9", "goal set");
  expect_problem(condition_problem(R"(<Condition type="AABB" min_x="1" max_x="0" min_y="0" max_y="1"
                                      inside="1"/>)"),
                 "Condition", "max_x", "0", "1");
}

TEST(Errors, InBehavior) {
  expect_problem(behavior_problem("<BFSM/>"), "BFSM", "", "no states", "<State>");
  expect_problem(
      behavior_problem(R"(<BFSM><State name="Start" final="0"/><Task type="x"/></BFSM>)"), "Task",
      "type", "x", "there are no types");
  expect_problem(behavior_problem(R"(<BFSM><State name="Start"/></BFSM>)"), "State", "final",
                 "nothing", "");
  expect_problem(
      behavior_problem(
          R"(<BFSM><State name="Start" final="0"/><State name="Start" final="0"/></BFSM>)"),
      "State", "name", "again", "name");
  expect_problem(behavior_problem(R"(<BFSM><GoalSet id="1"/><State name="Start" final="0">
                          <GoalSelector type="random" goal_set="1"/></State></BFSM>)"),
                 "GoalSelector", "goal_set", "empty", "<Goal>");
  expect_problem(behavior_problem(R"(<BFSM><GoalSet id="1"><Goal id="0" type="cube"/></GoalSet>
                                     <State name="Start" final="0"/></BFSM>)"),
                 "Goal", "type", "cube", "circle");
  expect_problem(
      behavior_problem(R"(<BFSM><GoalSet id="1"><Goal id="0" type="point" x="0"/></GoalSet>
                                     <State name="Start" final="0"/></BFSM>)"),
      "Goal", "y", "nothing", "");
  expect_problem(behavior_problem(R"(<BFSM><State name="Start" final="0"/>
                                     <Transition from="Start" to="Nowhere"><Condition type="auto"/>
                                     </Transition></BFSM>)"),
                 "Transition", "to", "Nowhere", "Start");
  expect_problem(behavior_problem(R"(<BFSM><State name="Start" final="0"/>
                                     <Transition from="Start,Nowhere" to="Start">
                                     <Condition type="auto"/></Transition></BFSM>)"),
                 "Transition", "from", "Nowhere", "Start");
  expect_problem(behavior_problem(R"(<BFSM><State name="Start" final="0"/>
                                     <Transition from="Start" to="Start"/></BFSM>)"),
                 "Transition", "", "no <Condition>", "one");
  expect_problem(behavior_problem(R"(<BFSM><State name="Start" final="0"/>
                                     <Transition from="Start"><Condition type="auto"/>
                                     <Target type="prob"><State name="Start" weight="0"/></Target>
                                     </Transition></BFSM>)"),
                 "Target", "", "weights of 0", "above 0");
  expect_problem(behavior_problem(R"(<BFSM><State name="Start" final="0">
                                     <Action type="set_property" property="mood" dist="c" value="1"/>
                                     </State></BFSM>)"),
                 "Action", "property", "mood", "pref_speed");
  expect_problem(behavior_problem(R"(<BFSM><State name="Start" final="0">
                                     <Action type="set_property" property="r" dist="c" value="-1"/>
                                     </State></BFSM>)"),
                 "Action", "", "-1", "from");
}

TEST(Errors, InScene) {
  const auto problem = [](const std::string& scene) {
    return caught_problem(scene, mirror_behavior());
  };
  const auto with_obstacle = [&](const std::string& vertices, const std::string& closed = "1") {
    return problem(scene_with(agent_at(0, 0), "", "Start",
                              R"(<ObstacleSet type="explicit" class="1"><Obstacle closed=")" +
                                  closed + "\">" + vertices + "</Obstacle></ObstacleSet>"));
  };
  const std::string a = R"(<Vertex p_x="0" p_y="0"/>)";
  const std::string b = R"(<Vertex p_x="1" p_y="0"/>)";
  const std::string c = R"(<Vertex p_x="1" p_y="1"/>)";
  expect_problem(with_obstacle(a + b), "Obstacle", "", "2 corners", "three");
  expect_problem(with_obstacle(a + b + b + c), "Obstacle", "", "two corners at (1, 0)", "apart");
  expect_problem(with_obstacle(a + b + R"(<Vertex p_x="2" p_y="0"/>)"), "Obstacle", "",
                 "without area", "counter-clockwise");
  expect_problem(with_obstacle(a + b + c, "0"), "Obstacle", "closed", "0", "1");
  expect_problem(problem(scene_with("")), "Generator", "", "no agents", "<Agent>");
  expect_problem(problem(scene_with(agent_at(0, 0), "", "Nowhere")), "StateSelector", "name",
                 "Nowhere", "Start");
  expect_problem(problem(scene_with(agent_at(0, 0), R"(r="0")")), "Common", "r", "0", "from 0.01");
  expect_problem(problem("<Experiment/>"), "Experiment", "", "no <Common>", "one");
  expect_problem(problem(R"(<Experiment><SpatialQuery type="octree"/></Experiment>)"),
                 "SpatialQuery", "type", "octree", "kd-tree");
  expect_problem(problem(R"(<Experiment><SpatialQuery type="kd-tree"/><Common/>
                            <AgentProfile name="a"/></Experiment>)"),
                 "Experiment", "", "no <AgentGroup>", "one");
  expect_problem(problem(R"(<Experiment><SpatialQuery type="kd-tree"/><Common/>
                            <AgentProfile name="a" inherits="b"/></Experiment>)"),
                 "AgentProfile", "inherits", "b", "further up");
  expect_problem(problem("<BFSM/>"), "BFSM", "", "not known here", "Experiment");
}

TEST(Errors, MalformedXmlHasALine) {
  const Problem problem = behavior_problem("<BFSM>\n<State name=\"Start\" final=\"0\">\n</BFSM>");
  EXPECT_EQ(problem.source, "behavior.xml");
  EXPECT_THAT(problem.where, testing::StartsWith("line "));
  EXPECT_EQ(problem.expected, "well-formed XML");
  EXPECT_EQ(behavior_problem("").expected, "well-formed XML");
}

TEST(Errors, AMissingFileIsTheMachines) {
  EXPECT_THROW(Simulation("/nowhere/s.xml", "/nowhere/b.xml", {}), EnvironmentError);
}

TEST(Errors, AnUnknownModelIsTheUsers) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(Simulation(folder.write("s.xml", scene_with(agent_at(0, 0))),
                          folder.write("b.xml", mirror_behavior()), {.model = "dance"}),
               InputError);
}

std::string file_text(const std::string& name) {
  std::stringstream text;
  text << std::ifstream(test::city_square(name), std::ios::binary).rdbuf();
  return text.str();
}

/// The text with a few parts changed, cut or doubled.
std::string mutated(std::string text, Random& random) {
  static const std::vector<std::string> kPieces = {
      "\"",  "<",      ">",    "/>", "&#0;", "-1",        "1e99",  "nan", "99999999999", "", "\0x",
      "]]>", "<Goal>", "\xff", "0",  "<!--", "type=\"\"", "State", "="};
  const int edits = 1 + static_cast<int>(random.below(4));
  for (int i = 0; i < edits && !text.empty(); ++i) {
    const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
    const std::size_t length = random.below(40);
    switch (random.below(5)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(random.below(static_cast<std::uint32_t>(text.size())), length));
        break;
      case 3: {
        // Swaps a number, where most of the meaning is.
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text.replace(digit, 1, kPieces[random.below(9)]);
        break;
      }
      default:
        text.replace(at, 1, kPieces[random.below(static_cast<std::uint32_t>(kPieces.size()))]);
    }
  }
  return text;
}

TEST(Errors, MutatedFilesAreRejectedOrRunButNeverCrash) {
  const std::string scene = file_text("square_scene.xml");
  const std::string behavior = file_text("nearest_exit_behavior.xml");
  const test::TemporaryFolder folder;
  int rejected = 0;
  int accepted = 0;
  const auto whole_scene = folder.write("scene.xml", scene);
  const auto whole_behavior = folder.write("behavior.xml", behavior);
  for (std::uint64_t i = 0; i < 300; ++i) {
    Random random(2024, Stream::crowd_generator, i);
    const bool in_scene = random.below(2) == 0;
    const auto scene_file =
        in_scene ? folder.write("mutated.xml", mutated(scene, random)) : whole_scene;
    const auto behavior_file =
        in_scene ? whole_behavior : folder.write("mutated.xml", mutated(behavior, random));
    try {
      Simulation crowd(scene_file, behavior_file, {.seed = i});
      if (crowd.agent_count() < 2000) crowd.step();
      ++accepted;
    } catch (const InputError& error) {
      ++rejected;
      const Problem& problem = error.problems().front();
      EXPECT_FALSE(problem.source.empty()) << problem.text();
      EXPECT_THAT(problem.where, testing::HasSubstr("line ")) << problem.text();
      EXPECT_FALSE(problem.found.empty() || problem.expected.empty()) << problem.text();
      for (const char c : problem.text()) EXPECT_TRUE(c >= ' ' && c <= '~') << problem.text();
    }
  }
  EXPECT_GT(rejected, 90);
  EXPECT_GT(accepted, 15) << "some changes are harmless";
}

TEST(Errors, UnknownAttributesAreOnlyWarnedOf) {
  const Simulation crowd = load(scene_with(agent_at(0, 0), R"(mass="80")"),
                                condition_behavior(R"(<Condition type="auto" colour="red"/>)"));
  ASSERT_EQ(crowd.warnings().size(), 2);
  expect_problem(crowd.warnings()[0], "Common", "mass", "unknown", "max_speed");
  expect_problem(crowd.warnings()[1], "Condition", "colour", "unknown", "type");
}

}  // namespace
}  // namespace throng::crowd
