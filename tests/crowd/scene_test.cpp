// Elements of a scene file, through the crowd that it makes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::mirror_behavior;
using test::scene_with;

std::string scene_text(const std::string& generator) {
  return R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Common/>
    <AgentProfile name="a"/><AgentGroup><ProfileSelector type="const" name="a"/>
    <StateSelector type="const" name="Start"/>)" +
         generator + "</AgentGroup></Experiment>";
}

std::vector<Eigen::Vector2f> generated_positions(const std::string& generator) {
  const Simulation crowd = load(scene_text(generator), mirror_behavior());
  return {crowd.positions().begin(), crowd.positions().end()};
}

/// With discs of radius 0.5 m.
std::string lattice(const std::string& alignment, const std::string& rows, double width,
                    int population, double rotation = 0) {
  return fmt::format(R"(<Generator type="hex_lattice" anchor_x="10" anchor_y="20" alignment="{}"
      row_direction="{}" density="{}" width="{}" population="{}" rotation="{}"/>)",
                     alignment, rows, 2 / std::sqrt(3.0), width, population, rotation);
}

const float kRow = std::sqrt(3.0F) / 2;

TEST(HexLattice, RowsAlternateAndAreCompleted) {
  const auto places = generated_positions(lattice("center", "x", 3.2, 9));
  ASSERT_EQ(places.size(), 10U) << "3 + 2 + 3 + 2: the first whole number of rows above 9";
  const std::vector<Eigen::Vector2f> wanted = {
      {9, 20},           {10, 20},           {11, 20},           {9.5, 20 + kRow},
      {10.5, 20 + kRow}, {9, 20 + 2 * kRow}, {10, 20 + 2 * kRow}};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_LT((places[i] - wanted[i]).norm(), 1e-4F) << i;
  }
  // As Menge has it, a population that fills its rows gets one row more.
  EXPECT_EQ(generated_positions(lattice("center", "x", 3.2, 10)).size(), 13U);
  EXPECT_EQ(generated_positions(lattice("center", "x", 0.5, 1)).size(), 2U)
      << "rows of one at least";
}

TEST(HexLattice, ColumnsRunUpwardsSideBySide) {
  const auto places = generated_positions(lattice("left", "y", 2.7, 7));
  ASSERT_EQ(places.size(), 9U) << "3 columns of 3";
  const std::vector<Eigen::Vector2f> wanted = {{10, 20}, {10, 21}, {10, 22}, {10 + kRow, 20.5}};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_LT((places[i] - wanted[i]).norm(), 1e-4F) << i;
  }
}

TEST(HexLattice, IsAlignedAndTurnedAboutTheAnchor) {
  EXPECT_LT((generated_positions(lattice("left", "x", 3.2, 2))[0] - Eigen::Vector2f(10, 20)).norm(),
            1e-4F);
  EXPECT_LT(
      (generated_positions(lattice("right", "x", 3.2, 2))[2] - Eigen::Vector2f(10, 20)).norm(),
      1e-4F);
  const auto turned = generated_positions(lattice("left", "x", 3.2, 9, 90));
  EXPECT_LT((turned[1] - Eigen::Vector2f(10, 21)).norm(), 1e-4F);
  EXPECT_LT((turned[3] - Eigen::Vector2f(10 - kRow, 20.5)).norm(), 1e-4F);
}

TEST(HexLattice, NobodyIsNearerThanTheDensityAllows) {
  for (const char* rows : {"x", "y"}) {
    const auto places = generated_positions(lattice("center", rows, 7.3, 60, 33));
    ASSERT_GE(places.size(), 60U);
    for (std::size_t i = 0; i < places.size(); ++i) {
      float nearest = 100;
      for (std::size_t j = 0; j < places.size(); ++j) {
        if (i != j) nearest = std::min(nearest, (places[i] - places[j]).norm());
      }
      EXPECT_NEAR(nearest, 1, 1e-3F) << i;
    }
  }
}

TEST(HexLattice, RejectsHugeNumbers) {
  EXPECT_THROW(generated_positions(lattice("center", "x", 1e5, 4000000)), InputError);
  EXPECT_THROW(generated_positions(lattice("middle", "x", 5, 4)), InputError);
}

TEST(Generators, PlacesMayHaveToBeOnAMesh) {
  const test::TemporaryFolder folder;
  folder.write("floor.nav", "4\n0 0\n4 0\n4 4\n0 4\n0\n0\nroom\n1\n2 2\n4 0 1 2 3\n0 0 0\n0\n0\n");
  const auto load_at = [&](const std::string& group, double x) {
    return Simulation(
        folder.write("s.xml",
                     scene_text(R"(<Generator type="nav_mesh_explicit" file_name="floor.nav")" +
                                group + ">" + agent_at(x, 2) + "</Generator>")),
        folder.write("b.xml", mirror_behavior()), {});
  };
  EXPECT_EQ(load_at("", 1).agent_count(), 1U);
  EXPECT_EQ(load_at(R"( group_name="room")", 1).agent_count(), 1U);
  EXPECT_THROW(load_at(R"( group_name="hall")", 1), InputError);
  EXPECT_THROW(load_at("", 5), InputError);
}

TEST(Profiles, WeightsAreShares) {
  std::string profiles;
  for (const char* name : {"a", "b", "c"}) {
    profiles += fmt::format(R"(<AgentProfile name="{}"><Common class="{}"/></AgentProfile>)", name,
                            static_cast<int>(name[0] - 'a'));
  }
  const Simulation crowd =
      load(R"(<Experiment><SpatialQuery type="kd-tree"/><Common/>)" + profiles +
               R"(<AgentGroup><ProfileSelector type="weighted">
      <Profile name="a" weight="1"/><Profile name="b" weight="2"/><Profile name="c" weight="7"/>
      </ProfileSelector><StateSelector type="const" name="Start"/>
      <Generator type="rect_grid" anchor_x="0" anchor_y="0" offset_x="1" offset_y="1" count_x="50"
        count_y="40"/></AgentGroup></Experiment>)",
           mirror_behavior());
  std::array<int, 3> counts{};
  for (const std::int32_t c : crowd.agent_classes()) ++counts.at(static_cast<std::size_t>(c));
  EXPECT_NEAR(counts[0], 200, 50);
  EXPECT_NEAR(counts[1], 400, 70);
  EXPECT_NEAR(counts[2], 1400, 80);
}

TEST(Profiles, TheirModifiersComeLastAndAreInherited) {
  const auto speed_of = [](const std::string& profile) {
    Simulation crowd = load(R"(<Experiment><SpatialQuery type="kd-tree"/><Common/>
      <AgentProfile name="plain"><Common max_accel="1000"/></AgentProfile>
      <AgentProfile name="slow"><Common max_accel="1000"/>
        <VelModifier type="scale" scale="0.5"/></AgentProfile>
      <AgentProfile name="slower" inherits="slow"><VelModifier type="scale" scale="0.5"/>
        </AgentProfile><AgentGroup><ProfileSelector type="const" name=")" +
                                profile + R"("/><StateSelector type="const" name="Start"/>
      <Generator type="explicit">)" +
                                agent_at(10, 0) + "</Generator></AgentGroup></Experiment>",
                            mirror_behavior());
    crowd.step();
    return crowd.velocities()[0].norm();
  };
  EXPECT_NEAR(speed_of("plain"), 1.34, 1e-3);
  EXPECT_NEAR(speed_of("slow"), 0.67, 1e-3);
  EXPECT_NEAR(speed_of("slower"), 0.335, 1e-3);
}

std::vector<std::string> obstacle_warnings(const std::string& corners, double agent_x) {
  const Simulation crowd =
      load(scene_with(agent_at(agent_x, 0.2), "", "Start",
                      R"(<ObstacleSet type="explicit" class="1"><Obstacle closed="1">)" + corners +
                          "</Obstacle></ObstacleSet>"),
           mirror_behavior());
  std::vector<std::string> texts;
  for (const Problem& warning : crowd.warnings()) texts.push_back(warning.text());
  return texts;
}

TEST(ObstacleSets, WarnOfTheWrongWinding) {
  const std::string a = R"(<Vertex p_x="-5" p_y="-5"/>)";
  const std::string b = R"(<Vertex p_x="5" p_y="-5"/>)";
  const std::string c = R"(<Vertex p_x="0" p_y="5"/>)";
  EXPECT_THAT(obstacle_warnings(a + b + c, 20), testing::IsEmpty()) << "solid, agents outside";
  EXPECT_THAT(obstacle_warnings(a + c + b, 0), testing::IsEmpty()) << "a wall around people";
  EXPECT_THAT(
      obstacle_warnings(a + c + b, 20),
      testing::ElementsAre(testing::HasSubstr("clockwise order, which keep people inside")));
  EXPECT_THAT(obstacle_warnings(a + b + c, 0),
              testing::ElementsAre(testing::HasSubstr("agents that start inside")));
}

TEST(Compat, WordsAreNumbersForMenge) {
  const std::string behavior = R"(<BFSM><State name="Start" final="true"/></BFSM>)";
  const auto loaded = [&](Compat compat) {
    return load(scene_with(agent_at(0, 0)), behavior, {.compat = compat});
  };
  const Simulation plain = loaded(Compat::none);
  const Simulation menge = loaded(Compat::menge);
  EXPECT_TRUE(plain.all_final());
  EXPECT_FALSE(menge.all_final()) << "a word is 0";
  for (const Simulation* crowd : {&plain, &menge}) {
    EXPECT_THAT(crowd->warnings().front().text(), testing::HasSubstr("Menge reads words as 0"));
  }
}

TEST(Scene, DropsALastCornerThatRepeatsTheFirst) {
  const std::string square = R"(<ObstacleSet type="explicit" class="1"><Obstacle closed="1">
      <Vertex p_x="3" p_y="0"/><Vertex p_x="4" p_y="0"/><Vertex p_x="4" p_y="1"/>
      <Vertex p_x="3" p_y="1"/>)";
  const std::string end = "</Obstacle></ObstacleSet>";
  const auto loaded = [&](const std::string& more) {
    return test::load(
        test::scene_with(test::agent_at(0, 0), R"(obstacleSet="1")", "Start", square + more + end),
        test::mirror_behavior());
  };
  const Simulation crowd = loaded(R"(<Vertex p_x="3" p_y="0"/>)");
  ASSERT_EQ(crowd.warnings().size(), 1U);
  EXPECT_NE(crowd.warnings()[0].text().find("repeats the first at (3, 0)"), std::string::npos)
      << crowd.warnings()[0].text();
  EXPECT_TRUE(loaded("").warnings().empty());
  EXPECT_THROW(loaded(R"(<Vertex p_x="3" p_y="1"/>)"), InputError) << "twice in between";
}

}  // namespace
}  // namespace throng::crowd
