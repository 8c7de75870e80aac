// Fields of directions from files.
#include "crowd/navigation/vector_field.h"

#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

/// Two rows of three cells of 2 m from (-1, 10) on; x grows with the column, y with the row.
const std::string kField = "2 3\n2\n-1 10\n0 1\n1 1\n2 1\n0 2\n1 2\n2 2\n";

TEST(VectorField, IsLookedUpAndInterpolated) {
  const test::TemporaryFolder folder;
  const VectorField field(folder.write("f.txt", kField));
  EXPECT_EQ(field.nearest({-0.9F, 10.1F}), Eigen::Vector2f(0, 1));
  EXPECT_EQ(field.nearest({1.1F, 11.9F}), Eigen::Vector2f(1, 1));
  EXPECT_EQ(field.nearest({2.9F, 12.1F}), Eigen::Vector2f(1, 2));
  EXPECT_EQ(field.nearest({100, -100}), Eigen::Vector2f(2, 1)) << "outside: the nearest cell";
  EXPECT_EQ(field.interpolated({2, 12}), Eigen::Vector2f(1, 1.5F));
  EXPECT_EQ(field.interpolated({3, 12}), Eigen::Vector2f(1.5F, 1.5F));
  EXPECT_EQ(field.interpolated({-50, 50}), Eigen::Vector2f(0, 2));
}

TEST(VectorField, SetsDirectionAndSpeed) {
  const test::TemporaryFolder folder;
  folder.write("f.txt", kField);
  const auto velocity = [&](const std::string& extra) {
    const Simulation crowd(
        folder.write("s.xml", test::scene_with(test::agent_at(2, 12), R"(pref_speed="1.2")")),
        folder.write("b.xml", fmt::format(R"(<BFSM><State name="Start" final="0">
      <VelComponent type="vel_field" file_name="f.txt" {}/></State></BFSM>)",
                                          extra)),
        {});
    return crowd.preferred_velocity(0);
  };
  EXPECT_LT((velocity("") - Eigen::Vector2f(1.2F, 2.4F)).norm(), 1e-5F);
  EXPECT_LT((velocity(R"(use_nearest="0")") - Eigen::Vector2f(1.2F, 1.8F)).norm(), 1e-5F);
}

TEST(VectorField, ReportsMistakes) {
  const test::TemporaryFolder folder;
  for (const std::string text : {"", "2 3\n", "2 3\n0\n0 0\n", "100000 100000\n1\n0 0\n1 1\n",
                                 "1 1\n1\n0 0\n1 nan\n", "1 1\n1\n0 0\n1 1\n1 1\n"}) {
    EXPECT_THROW(VectorField(folder.write("f.txt", text)), InputError) << text;
  }
}

}  // namespace
}  // namespace throng::crowd
