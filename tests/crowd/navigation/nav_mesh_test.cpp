// Navigation meshes from files, and paths across them.
#include "crowd/navigation/nav_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "crowd/navigation/nav_mesh_file.h"
#include "crowd/navigation/path_finder.h"
#include "crowd/navigation/walkable_mesh.h"
#include "tests/crowd/crowd_files.h"
#include "tests/crowd/navigation_files.h"

namespace throng::crowd {
namespace {

/// An L: a room from (0, 0) to (10, 4), and one from (6, 4) to (10, 12); its outline is the wall.
const std::string kCorner = R"(7
0 0
6 0
10 0
10 4
10 12
6 12
6 4
1
3 6 0 1
7
0 1 0 1
1 2 0 2
2 3 0 3
3 4 1 4
4 5 1 5
5 6 1 6
6 0 0 0
rooms
2
5 2
5 0 1 2 3 6
0 0 0
1 0
4 0 1 2 6
8 8
4 6 3 4 5
0 0 1
1 0
3 3 4 5
)";

/// The same with the walls' last edge leading from (6, 4) to (0, 4), which is a corner, too.
std::string corner_mesh() {
  std::string text = kCorner;
  text.replace(text.find("7\n0 0\n"), 2, "8\n");
  text.replace(text.find("6 4\n1\n"), 6, "6 4\n0 4\n1\n");
  text.replace(text.find("\n7\n0 1 0 1"), 3, "\n8\n");
  text.replace(text.find("6 0 0 0\n"), 8, "6 7 0 7\n7 0 0 0\n");
  text.replace(text.find("5 0 1 2 3 6"), 11, "6 0 1 2 3 6 7");
  return text;
}

std::string walk_to(double x, double y, const std::string& attributes = "") {
  return fmt::format(R"(<BFSM>
  <GoalSet id="1"><Goal type="point" id="0" x="{}" y="{}"/>
    <Goal type="point" id="1" x="1" y="3"/></GoalSet>
  <State name="Start" final="0"><GoalSelector type="explicit" goal_set="1" goal="0"/>
    <VelComponent type="nav_mesh" file_name="m.nav" {}/></State>
  <State name="End" final="1"/>
  <Transition from="Start" to="End"><Condition type="goal_reached" distance="0.2"/></Transition>
</BFSM>)",
                     x, y, attributes);
}

const std::string kWalls = R"(<ObstacleSet type="nav_mesh" class="1" file_name="m.nav"/>)";

Problem caught_problem(const std::string& mesh) {
  const test::TemporaryFolder folder;
  try {
    load_nav_mesh(folder.write("m.nav", mesh));
  } catch (const InputError& error) {
    return error.problems()[0];
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(NavMesh, IsReadFromAFile) {
  const test::TemporaryFolder folder;
  const NavMeshFile file = load_nav_mesh(folder.write("m.nav", corner_mesh()));
  EXPECT_EQ(file.groups, std::vector<std::string>{"rooms"});
  ASSERT_EQ(file.mesh.polygons().size(), 2U);
  EXPECT_EQ(file.mesh.find({1, 1}), 0);
  EXPECT_EQ(file.mesh.find({7, 11}, 0), 1);
  EXPECT_EQ(file.mesh.find({1, 11}), -1);
  EXPECT_EQ(file.mesh.nearest({5, 8}).point, Eigen::Vector2f(6, 8));
  EXPECT_EQ(file.mesh.nearest({5, 8}).polygon, 1);
  ASSERT_EQ(file.outlines.size(), 1U);
  Obstacles walls;
  walls.add_polygon(file.outlines[0], 1);
  EXPECT_FALSE(walls.polygons()[0].solid) << "people walk inside";
}

TEST(NavMesh, ReportsMistakesWithTheirLine) {
  EXPECT_EQ(caught_problem("").found, "the end of the file");
  EXPECT_NE(caught_problem("99999999 0 0").expected.find("no more than follow"), std::string::npos);
  EXPECT_EQ(caught_problem("3\n0 0\n1 x\n").where, "line 3");
  std::string mesh = corner_mesh();
  mesh.replace(mesh.find("6 0 1 2 3 6 7"), 13, "6 0 1 2 3 6 9");
  EXPECT_EQ(caught_problem(mesh).found, "\"9\"");
  mesh = corner_mesh();
  mesh.replace(mesh.find("3 6 0 1"), 7, "3 6 0 8");
  EXPECT_FALSE(caught_problem(mesh).found.empty());
  mesh = corner_mesh();
  mesh.replace(mesh.find("7 0 0 0"), 7, "7 0 0 3");
  EXPECT_NE(caught_problem(mesh).found.find("does not close"), std::string::npos);
}

TEST(NavMesh, AgentsWalkAroundTheCorner) {
  const test::TemporaryFolder folder;
  folder.write("m.nav", corner_mesh());
  Simulation crowd(
      folder.write("s.xml", test::scene_with(test::agent_at(1, 3), "", "Start", kWalls)),
      folder.write("b.xml", walk_to(7, 11)), {});
  while (!crowd.all_final() && crowd.time_s() < 30) crowd.step();
  ASSERT_TRUE(crowd.all_final());
  const double shortest = std::hypot(5.2, 1) + std::hypot(0.8, 7);
  EXPECT_LT(crowd.time_s(), 1.1 * shortest / 1.34);
}

TEST(NavMesh, WaysKeepTheAgentsRadiusFromCorners) {
  const test::TemporaryFolder folder;
  const NavMesh mesh = load_nav_mesh(folder.write("m.nav", corner_mesh())).mesh;
  PathFinder finder(mesh);
  ASSERT_TRUE(finder.find({0, {1, 3}}, {1, {7, 11}}, 0.5F));
  ASSERT_EQ(finder.bends().size(), 2U);
  EXPECT_LT((finder.bends()[0] - Eigen::Vector2f(6.5F, 4)).norm(), 1e-5F);
  EXPECT_NEAR(finder.length_m(), std::hypot(5.5, 1) + std::hypot(0.5, 7), 1e-4);
  ASSERT_TRUE(finder.find({0, {1, 3}}, {1, {7, 11}}, 3)) << "too narrow, but the only way";
}

TEST(NavMesh, AgentsOutsideOfItAreReported) {
  const test::TemporaryFolder folder;
  folder.write("m.nav", corner_mesh());
  try {
    const Simulation crowd(
        folder.write("s.xml", test::scene_with(test::agent_at(1, 3) + test::agent_at(2, 9))),
        folder.write("b.xml", walk_to(7, 11)), {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems()[0].source, "m.nav");
    EXPECT_NE(error.problems()[0].where.find("agent 1 at (2.00, 9.00)"), std::string::npos);
  }
}

TEST(NavMesh, SelectorsMeasureAlongTheWay) {
  const test::TemporaryFolder folder;
  folder.write("m.nav", corner_mesh());
  const auto goal_by = [&](const std::string& selector) {
    std::string behavior = walk_to(6.5, 11);
    const std::string plain = R"(type="explicit" goal_set="1" goal="0")";
    behavior.replace(behavior.find(plain), plain.size(),
                     fmt::format(R"(type="{}" goal_set="1" file_name="m.nav")", selector));
    // Straight, (6.5, 11) is farther from (9, 3.5) than (1, 3) is; along the way it is nearer to
    // (6.2, 6) and (1, 3) is farther.
    const Simulation crowd(folder.write("s.xml", test::scene_with(test::agent_at(6.2, 7))),
                           folder.write("b.xml", behavior), {});
    return crowd.goals()[0].goal;
  };
  EXPECT_EQ(goal_by("nearest_nav_mesh"), 0);
  EXPECT_EQ(goal_by("farthest_nav_mesh"), 1);
}

TEST(NavMesh, StraightWaysAreKnownToBeClear) {
  const std::vector<Box> boxes = test::random_boxes(12, 30, 5);
  Obstacles walls;
  std::vector<Box> tight;
  std::vector<Box> wide;
  for (const Box& box : boxes) {
    walls.add_polygon(test::box_corners(box), 1);
    tight.push_back(test::grown(box, 0.2F));
    wide.push_back(test::grown(box, 0.6F));
  }
  walls.build();
  const NavMesh mesh = make_walkable_mesh(walls, 1, 0.4F, {{0, 0}, {30, 30}}, {});
  int clear = 0;
  int blocked = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Random random(6, Stream::crowd_profile, i);
    const auto draw = [&] { return static_cast<float>(random.uniform(-3, 33)); };
    const Eigen::Vector2f from(draw(), draw());
    const Eigen::Vector2f to(draw(), draw());
    const int polygon = mesh.find(from);
    if (polygon < 0 || mesh.find(to) < 0) continue;
    if (mesh.is_clear({polygon, from}, to)) {
      EXPECT_TRUE(test::sees(tight, from, to)) << i;
      ++clear;
    } else {
      EXPECT_FALSE(test::sees(wide, from, to)) << i;
      ++blocked;
    }
  }
  EXPECT_GT(clear, 20);
  EXPECT_GT(blocked, 20);
}

}  // namespace
}  // namespace throng::crowd
