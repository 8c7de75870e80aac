#include "world/exits/exit_overlap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace throng::world {
namespace {

using Eigen::Vector2d;
using ::testing::AllOf;
using ::testing::HasSubstr;

Exit make_exit(std::string id, const Vector2d& from, const Vector2d& to, const Vector2d& outward) {
  Exit exit;
  exit.id = std::move(id);
  exit.from = from;
  exit.to = to;
  exit.outward = outward.normalized();
  return exit;
}

const Exit kNorth = make_exit("north", {0, 10}, {4, 10}, {0, 1});

/// The findings about the north gate and another one, in every direction of the compass and in both
/// orders.
std::vector<std::string> overlap_message(const Exit& other) {
  std::vector<std::string> said;
  for (const double turn_rad : {0.0, 0.4, 2.0, std::numbers::pi}) {
    const Eigen::Rotation2Dd turn(turn_rad);
    const auto turned = [&](const Exit& exit) {
      return make_exit(exit.id, turn * exit.from, turn * exit.to, turn * exit.outward);
    };
    for (const bool swapped : {false, true}) {
      const Exit first = turned(swapped ? other : kNorth);
      const Exit second = turned(swapped ? kNorth : other);
      const std::vector<ExitOverlap> found = overlapping_exits({first, second});
      said.push_back(found.empty() ? "" : found.front().found);
    }
  }
  return said;
}

void expect_overlap(const Exit& other, const std::string& what = "") {
  for (const std::string& said : overlap_message(other)) {
    EXPECT_THAT(said,
                AllOf(HasSubstr("\"north\""), HasSubstr("\"" + other.id + "\""), HasSubstr(what)));
  }
}

void expect_none(const Exit& other) {
  for (const std::string& said : overlap_message(other)) EXPECT_EQ(said, "") << other.id;
}

TEST(ExitOverlap, ExitsMayNotLieOnEachOther) {
  expect_overlap(make_exit("same", {0, 10}, {4, 10}, {0, 1}), "4 m");
  expect_overlap(make_exit("backwards", {4, 10}, {0, 10}, {0, 1}), "4 m");
  expect_overlap(make_exit("way_in", {0, 10}, {4, 10}, {0, -1}), "4 m");
  expect_overlap(make_exit("half", {2, 10}, {7, 10}, {0, 1}), "2 m");
  expect_overlap(make_exit("within", {1, 10}, {1.7, 10}, {0, 1}), "0.7 m");
  expect_overlap(make_exit("a_bit", {3.8, 10}, {9, 10}, {0, 1}), "0.2 m");
  expect_overlap(make_exit("nearly", {1, 9.95}, {5, 10.02}, {-0.0175, 1}));
}

TEST(ExitOverlap, ExitsMayNotCross) {
  expect_overlap(make_exit("upright", {2, 8}, {2, 12}, {1, 0}), "crosses");
  expect_overlap(make_exit("oblique", {1, 9}, {3, 12}, {3, -2}), "crosses");
}

TEST(ExitOverlap, ExitsMayNotLieRightBehindEachOther) {
  expect_overlap(make_exit("porch", {0, 10.3}, {4, 10.3}, {0, 1}), "0.3 m behind");
  expect_overlap(make_exit("vestibule", {1, 11.8}, {3, 11.8}, {0, 1}), "1.8 m behind");
  expect_overlap(make_exit("back_to_back", {0, 10.15}, {4, 10.15}, {0, -1}));
  expect_overlap(make_exit("slanted", {0, 10.5}, {4, 11.5}, {-0.25, 1}), "behind");
}

TEST(ExitOverlap, ExitsMayTouchAndLieSideBySide) {
  expect_none(make_exit("next", {4, 10}, {8, 10}, {0, 1}));
  expect_none(make_exit("rounded", {3.99, 10}, {8, 10}, {0, 1}));
  expect_none(make_exit("beside", {4.5, 10}, {6, 10}, {0, 1}));
  expect_none(make_exit("set_back", {4, 10.5}, {8, 10.5}, {0, 1}));
  expect_none(make_exit("corner", {4, 10}, {4, 6}, {1, 0}));
  expect_none(make_exit("chamfer", {4, 10}, {6, 8}, {1, 1}));
  expect_none(make_exit("acute", {4, 10}, {3, 7}, {3, -1}));
}

TEST(ExitOverlap, ExitsOnOppositeSidesOfANarrowPlaceAreTwo) {
  expect_none(make_exit("south", {0, 9}, {4, 9}, {0, -1}));
}

TEST(ExitOverlap, AGateFartherAwayIsAnotherOne) {
  expect_none(make_exit("street", {0, 12.5}, {4, 12.5}, {0, 1}));
}

TEST(ExitOverlap, NamesEveryPair) {
  const std::vector<ExitOverlap> found = overlapping_exits({kNorth, kNorth, kNorth});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[2].first, 1U);
  EXPECT_EQ(found[2].second, 2U);
}

}  // namespace
}  // namespace throng::world
