// Descriptions as values: reading, writing, building, and the simulations made from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <future>
#include <sstream>

#include "base/error.h"
#include "base/files/resources.h"
#include "crowd/description/builder.h"
#include "crowd/description/menge_files/read.h"
#include "crowd/description/menge_files/write.h"
#include "crowd/simulation.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

namespace fs = std::filesystem;
using namespace describe;
using testing::HasSubstr;
using testing::Not;

/// Writes a description and reads the text.
Description rewritten(const Description& description, const test::TemporaryFolder& folder) {
  return read_description(folder.write("written.xml", to_xml(description)), "Root");
}

std::vector<fs::path> shipped_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() / "scenarios")) {
    if (entry.path().extension() == ".xml") files.push_back(entry.path());
  }
  return files;
}

std::vector<Eigen::Vector2f> positions_after(Simulation crowd, int steps) {
  for (int i = 0; i < steps; ++i) crowd.step();
  return {crowd.positions().begin(), crowd.positions().end()};
}

Problem caught_problem(const SceneDescription& scene, const BehaviorDescription& behavior) {
  try {
    const Simulation crowd(scene, behavior, {});
  } catch (const InputError& error) {
    return error.problems().front();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

SceneBuilder two_people() {
  SceneBuilder scene;
  scene.add_profile({.name = "adult",
                     .common = {{"r", 0.2}, {"max_speed", 2}, {"obstacleSet", 1}},
                     .properties = {property("pref_speed", Sampled::normal(1.34, 0.26))},
                     .models = {model("ORCA", {{"tau", 3}, {"tauObst", 0.4}})}});
  scene.add_group(
      {.profile = "adult", .state = "Walk", .generator = agents_at({{0, 0}, {0.1, 1.3}})});
  scene.add_obstacles({{{3, -1}, {4, -1}, {4, 1}, {3, 1}}});
  return scene;
}

BehaviorBuilder walk_right() {
  BehaviorBuilder behavior;
  behavior.add_goal_set(0, {circle_goal(0, {8, 0.5}, 1)});
  behavior.add_state("Walk", {select_goal("nearest", 0), velocity("auto")});
  behavior.add_final_state("Out", {action("leave")});
  behavior.add_transition("Walk", "Out", goal_reached(0.2));
  return behavior;
}

TEST(Descriptions, OfShippedFilesAreTheSameWhenWritten) {
  const test::TemporaryFolder folder;
  const std::vector<fs::path> files = shipped_files();
  ASSERT_GE(files.size(), 15U);
  for (const fs::path& file : files) {
    const Description read = read_description(file, "Root");
    EXPECT_EQ(rewritten(read, folder).root, read.root) << file;
    EXPECT_EQ(to_xml(rewritten(read, folder)), to_xml(read)) << file << ": not even its comments";
  }
}

TEST(Descriptions, KeepEveryCharacterOfTheirValues) {
  const test::TemporaryFolder folder;
  Node root("Root");
  std::string controls;
  for (char c = 1; c < ' '; ++c) controls += c;
  root.set({"a.b-c:d", "  <&>\"'  "})
      .set({"_", controls})
      .set({"\xC3\xA9", "\xF0\x9F\x9A\xB6 \xC3\xA9"});
  root.set({"empty", ""}).set({"entity", "&amp;&#10;]]>"}).set({"lines", "a\r\nb\rc\n"});
  Node mixed("Obstacle", {}, vertices({{0, 0}, {1e-300, -0.1}}));
  mixed.comment = "--- what -- follows -";
  mixed.add(Node("Vertex", {}, {Node("Deep")})).add(Node("Other"));
  root.add(mixed).add(Node("Obstacle", {}, vertices({{1.0 / 3, 1e17}})));
  Node deep("d");
  for (int i = 0; i < 90; ++i) deep = Node("d", {}, {deep});
  root.add(deep);
  const Description nasty{root, "nasty"};
  const Description again = rewritten(nasty, folder);
  EXPECT_EQ(again.root, root);
  EXPECT_EQ(rewritten(again, folder).root.children[0].comment, again.root.children[0].comment);
  EXPECT_EQ(again.root.children[0].line, 4) << "below the declaration and the comment";
}

TEST(Descriptions, ThatXmlCannotHoldAreNotWritten) {
  const auto problem = [](Node node) {
    try {
      to_xml({std::move(node), "made"});
    } catch (const InputError& error) {
      return error.problems().front().found;
    }
    return std::string("written");
  };
  EXPECT_THAT(problem(Node("a b")), HasSubstr("a b"));
  EXPECT_THAT(problem(Node("")), HasSubstr("name"));
  EXPECT_THAT(problem(Node("a", {}, {Node("1")})), HasSubstr("1"));
  EXPECT_THAT(problem(Node("a", {{"b>", 1}})), HasSubstr("b>"));
  EXPECT_THAT(problem(Node("a", {{"b", 1}, {"b", 2}})), HasSubstr("twice"));
  EXPECT_THAT(problem(Node("a", {{"b", std::string("x\0y", 3)}})), HasSubstr("0"));
  EXPECT_THAT(problem(Node("a", {{"b", "\xFF"}})), HasSubstr("UTF-8"));
}

TEST(Descriptions, InMemoryMoveAsTheirFilesDo) {
  const test::TemporaryFolder folder;
  const fs::path square = source_folder() / "scenarios/city_square";
  const fs::path scene = square / "square_scene.xml";
  const fs::path behavior = square / "nearest_exit_behavior.xml";
  const auto from_files = positions_after(Simulation(scene, behavior, {.seed = 5}), 40);
  EXPECT_EQ(
      positions_after(Simulation(read_scene(scene), read_behavior(behavior), {.seed = 5}), 40),
      from_files);
  const fs::path written_scene = folder.write("s.xml", to_xml(read_scene(scene)));
  const fs::path written_behavior = folder.write("b.xml", to_xml(read_behavior(behavior)));
  EXPECT_EQ(positions_after(Simulation(written_scene, written_behavior, {.seed = 5}), 40),
            from_files);
}

TEST(Builders, BuildTheDescriptionOfAFile) {
  const test::TemporaryFolder folder;
  const fs::path scene = folder.write("scene.xml", R"(<Experiment version="2.0">
    <SpatialQuery type="kd-tree" test_visibility="0"/><Common time_step="0.1"/>
    <AgentProfile name="adult"><Common r="0.2" max_speed="2" obstacleSet="1">
      <Property name="pref_speed" dist="n" mean="1.34" stddev="0.26"/></Common>
      <ORCA tau="3" tauObst="0.4"/></AgentProfile>
    <AgentGroup><ProfileSelector type="const" name="adult"/><StateSelector type="const" name="Walk"/>
      <Generator type="explicit"><Agent p_x="0" p_y="0"/><Agent p_x="0.1" p_y="1.3"/></Generator>
    </AgentGroup>
    <ObstacleSet type="explicit" class="1"><Obstacle closed="1"><Vertex p_x="3" p_y="-1"/>
      <Vertex p_x="4" p_y="-1"/><Vertex p_x="4" p_y="1"/><Vertex p_x="3" p_y="1"/></Obstacle>
    </ObstacleSet></Experiment>)");
  const fs::path behavior = folder.write("behavior.xml", R"(<BFSM>
    <GoalSet id="0"><Goal id="0" type="circle" x="8" y="0.5" radius="1"/></GoalSet>
    <State name="Walk" final="0"><GoalSelector type="nearest" goal_set="0"/><VelComponent type="auto"/>
    </State><State name="Out" final="1"><Action type="leave"/></State>
    <Transition from="Walk" to="Out"><Condition type="goal_reached" distance="0.2"/></Transition>
    </BFSM>)");
  const SceneBuilder built = two_people();
  EXPECT_EQ(built.build().root, read_scene(scene).root);
  EXPECT_EQ(walk_right().build().root, read_behavior(behavior).root);
  EXPECT_EQ(positions_after(Simulation(built.build(), walk_right().build(), {.seed = 3}), 60),
            positions_after(Simulation(scene, behavior, {.seed = 3}), 60));
}

TEST(Builders, KeepACommentForTheNextElementOnly) {
  BehaviorBuilder behavior;
  behavior.comment("Where to go.").add_goal_set(1, {}).add_state("Walk");
  EXPECT_EQ(behavior.build().root.children[0].comment, "Where to go.");
  EXPECT_EQ(behavior.build().root.children[1].comment, "");
  EXPECT_THAT(to_xml(behavior.build()), HasSubstr("  <!-- Where to go. -->\n  <GoalSet"));
}

TEST(Builders, ReplaceAnAttributeThatIsSetAgain) {
  Node goal = circle_goal(0, {1, 2}, 3);
  goal.set({"x", 4.5}).set({"weight", 2});
  EXPECT_EQ(*goal.find("x"), "4.5");
  EXPECT_EQ(goal.attributes.size(), 6U);
  EXPECT_EQ(goal.find("X"), nullptr);
}

TEST(Errors, NameTheBuiltElement) {
  SceneBuilder scene = two_people();
  scene.add_group({.profile = "child", .state = "Walk", .generator = agents_at({{5, 5}})});
  Problem problem = caught_problem(scene.build(), walk_right().build());
  EXPECT_EQ(problem.source, "scene");
  EXPECT_THAT(problem.where, HasSubstr("built in code"));
  EXPECT_THAT(problem.where, HasSubstr(R"(<ProfileSelector type="const" name="child">)"));
  EXPECT_THAT(problem.where, Not(HasSubstr("line")));

  BehaviorBuilder behavior = walk_right();
  behavior.add_transition("Walk", "Gone", goal_reached());
  problem = caught_problem(two_people().build(), behavior.build());
  EXPECT_EQ(problem.source, "behavior");
  EXPECT_THAT(problem.where,
              HasSubstr(R"(built in code, element <Transition from="Walk" to="Gone">)"));

  behavior = walk_right();
  behavior.add_goal_set(1, {Node("Goal", {{"id", 0}, {"x", 1}, {"x", 2}})});
  problem = caught_problem(two_people().build(), behavior.build());
  EXPECT_THAT(problem.where, HasSubstr(R"(attribute "x")"));
  EXPECT_THAT(problem.found, HasSubstr("twice"));

  SceneDescription other = two_people().build();
  other.root.name = "Experimnt";
  EXPECT_THAT(caught_problem(other, walk_right().build()).found,
              HasSubstr("did you mean Experiment?"));
}

TEST(Errors, OfAFileThatWasChangedInCodeTellThemApart) {
  const test::TemporaryFolder folder;
  SceneDescription scene = read_scene(folder.write("scene.xml", to_xml(two_people().build())));
  BehaviorDescription behavior = walk_right().build();
  scene.root.children[2].children[0].set({"r", "wide"});
  Problem problem = caught_problem(scene, behavior);
  EXPECT_EQ(problem.source, "scene.xml");
  EXPECT_THAT(problem.where, HasSubstr("line 6, element <Common>"));
  scene.root.children[2].children[0].set({"r", 0.2});
  scene.root.add(Node("Wall", {{"p_x", 1}}));
  problem = caught_problem(scene, behavior);
  EXPECT_EQ(problem.source, "scene.xml");
  EXPECT_THAT(problem.where, HasSubstr(R"(built in code, element <Wall p_x="1">)"));
}

TEST(Descriptions, NameFilesOfTheirFolderOrInMemory) {
  const test::TemporaryFolder folder;
  folder.write("field.txt", "1 1\n10\n0 0\n0 1\n");
  BehaviorBuilder behavior;
  behavior.add_state("Walk", {select_own_place(), velocity("vel_field", {{"file_name", "field.txt"},
                                                                         {"use_nearest", 0}})});
  BehaviorDescription description = behavior.build();
  EXPECT_THROW(Simulation(two_people().build(), description, {}), InputError);
  description.folder = folder.path();
  const auto there = positions_after(Simulation(two_people().build(), description, {}), 10);
  EXPECT_GT(there[0].y(), 0.5F);

  description.folder.clear();
  description.files = {{"field.txt", "1 1\n10\n0 0\n0 1\n"}};
  EXPECT_EQ(positions_after(Simulation(two_people().build(), description, {}), 10), there);
  description.files = {{"field.txt", "1 1\n10\n0 0\n0 north\n"}};
  EXPECT_EQ(caught_problem(two_people().build(), description).source, "field.txt");
}

TEST(Descriptions, CanBeSimulatedSeveralTimesAtOnce) {
  SceneBuilder scene = two_people();
  scene.add_profile({.name = "odd", .common = {{"colour", "red"}}});
  const SceneDescription described = scene.build();
  const BehaviorDescription behavior = walk_right().build();
  const auto run = [&](std::uint64_t seed) {
    Simulation crowd(described, behavior, {.seed = seed});
    EXPECT_EQ(crowd.warnings().size(), 1U);
    return positions_after(std::move(crowd), 30);
  };
  auto first = std::async(std::launch::async, run, 1);
  auto second = std::async(std::launch::async, run, 1);
  const auto other = run(2);
  const auto positions = first.get();
  EXPECT_EQ(positions, second.get());
  EXPECT_NE(positions, other);
  EXPECT_EQ(described.root, scene.build().root);
}

}  // namespace
}  // namespace throng::crowd
