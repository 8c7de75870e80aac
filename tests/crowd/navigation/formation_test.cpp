#include "crowd/navigation/formation.h"

#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::scene_with;

std::vector<Eigen::Vector2f> places(const std::string& text) {
  const test::TemporaryFolder folder;
  return Formation(folder.write("formation.txt", text)).places();
}

TEST(Formation, PlacesAreByWeightAndAlongTheWay) {
  const auto read = places("2\n0 0 1\n0 2 5\n1 1 3\n0 1\n");
  ASSERT_EQ(read.size(), 3U);
  EXPECT_TRUE(read[0].isApprox(Eigen::Vector2f(2, 0))) << "ahead is +y in the file";
  EXPECT_TRUE(read[1].isApprox(Eigen::Vector2f(1, -1))) << "to the right";
  EXPECT_TRUE(read[2].isZero());
  EXPECT_EQ(places("1 0 0 1 1 0 0").size(), 1U) << "the way may have a weight";
}

TEST(Formation, BadFilesAreRejected) {
  for (const std::string& text :
       {std::string(), std::string("2 0 0 1"), std::string("1 0 0 1"), std::string("1 0 0 1 0 0"),
        std::string("1 0 0 1 5"), std::string("x"), std::string("1 0 0 nan 1 0"),
        std::string("1000000000 0 0 1 1 0"), std::string("0 1 0")}) {
    EXPECT_THROW(places(text), InputError) << text;
  }
}

TEST(Formation, AgentsTakeTheirPlacesOnTheWay) {
  // A wedge: one ahead, two behind.
  const test::TemporaryFolder folder;
  folder.write("wedge.txt", "3\n 0 2 3\n -2 0 1\n 2 0 1\n 0 1\n");
  Simulation crowd(
      folder.write("scene.xml", scene_with(agent_at(0, 0) + agent_at(0, 1) + agent_at(0, -1),
                                           R"(pref_speed="1" r="0.2")")),
      folder.write("behavior.xml", R"(<BFSM><State name="Start" final="1">
        <VelComponent type="const_dir" x="1" y="0"/>
        <VelModifier type="formation" file_name="wedge.txt"/></State></BFSM>)"),
      {});
  while (crowd.time_s() < 15) crowd.step();
  std::vector<Eigen::Vector2f> p(crowd.positions().begin(), crowd.positions().end());
  std::sort(p.begin(), p.end(), [](const auto& a, const auto& b) { return a.x() > b.x(); });
  EXPECT_GT(p[2].x(), 10) << "they go on";
  EXPECT_LT((p[0] - 0.5F * (p[1] + p[2]) - Eigen::Vector2f(2, 0)).norm(), 0.2F)
      << "the first is ahead of the middle of the others";
  EXPECT_NEAR((p[1] - p[2]).norm(), 4, 0.2);
  for (const Eigen::Vector2f& v : crowd.velocities()) {
    EXPECT_NEAR(v.x(), 1, 0.1);
    EXPECT_NEAR(v.y(), 0, 0.1);
  }
}

TEST(Formation, AgentsWithoutASlotWalkAlone) {
  const test::TemporaryFolder folder;
  folder.write("one.txt", "1\n 0 0 1\n 1 0\n");
  Simulation crowd(folder.write("scene.xml", scene_with(agent_at(0, 0) + agent_at(0, 5))),
                   folder.write("behavior.xml", R"(<BFSM><State name="Start" final="1">
        <VelComponent type="const_dir" x="1" y="0"/>
        <VelModifier type="formation" file_name="one.txt"/></State></BFSM>)"),
                   {});
  while (crowd.time_s() < 3) crowd.step();
  int straight = 0;
  for (const Eigen::Vector2f& v : crowd.velocities()) {
    if (std::abs(v.y()) < 1e-3F) ++straight;
  }
  EXPECT_EQ(straight, 1);
}

}  // namespace
}  // namespace throng::crowd
