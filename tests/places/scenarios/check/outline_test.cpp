// Halls with walls that lack pieces: the check names each place and its width.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "base/compute/random.h"
#include "places/scenarios/check/check.h"
#include "tests/places/scenarios/yard.h"

namespace throng::scenarios {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using throng::testing::TemporaryFolder;
using throng::testing::Yard;

struct NamedGap {
  double width_m = 0;
  Vector2d middle = Vector2d::Zero();
};

class Outline : public ::testing::Test {
 protected:
  std::vector<std::string> warnings() {
    std::vector<std::string> texts;
    for (const Finding& finding : check_files(yard.write(folder))) {
      EXPECT_EQ(finding.severity, Severity::warning) << finding.text();
      if (finding.problem.where == "/crowd/scene") texts.push_back(finding.text());
    }
    return texts;
  }
  /// The gaps as users read them.
  std::vector<NamedGap> gaps() {
    const std::regex said(R"(a gap ([0-9.]+) m wide at \[([-0-9.e]+), ([-0-9.e]+)\])");
    std::vector<NamedGap> found;
    for (const std::string& text : warnings()) {
      std::smatch match;
      if (!std::regex_search(text, match, said)) {
        ADD_FAILURE() << text;
        continue;
      }
      found.push_back({std::stod(match[1]), {std::stod(match[2]), std::stod(match[3])}});
    }
    return found;
  }
  void expect_gap(const NamedGap& expected) {
    const std::vector<NamedGap> found = gaps();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].width_m, expected.width_m, 0.11);
    EXPECT_LT((found[0].middle - expected.middle).norm(), 0.6) << found[0].middle.transpose();
  }

  /// The yard's walls but for the northern one, and the hut.
  std::string three_walls() {
    return Yard::box(-11, -11, -10, 11) + Yard::box(-10, -11, 11, -10) +
           Yard::box(10, 1.5, 11, 11) + Yard::box(10, -10, 11, -1.5) + Yard::box(-8, 4, -4, 8);
  }

  TemporaryFolder folder;
  Yard yard;
};

TEST_F(Outline, NamesAWallThatIsMissing) {
  yard.obstacles = three_walls();
  expect_gap({20, {0, 11}});
}

TEST_F(Outline, AMissingWallIsAtItsPlaceAndNotWherePeopleEnd) {
  yard.obstacles = three_walls() + Yard::box(10, 10, 11, 14) + Yard::box(-11, 10, -10, 14);
  yard.scenario["inside"]["max"] = {12, 15};
  expect_gap({20, {0, 14}});
}

TEST_F(Outline, NamesAGapInAWall) {
  yard.obstacles = three_walls() + Yard::box(-10, 10, 3, 11) + Yard::box(4.2, 10, 10, 11);
  expect_gap({1.2, {3.6, 10.5}});
}

TEST_F(Outline, NamesTheNearestExit) {
  yard.obstacles = three_walls() + Yard::box(-10, 10, 3, 11) + Yard::box(4.2, 10, 10, 11);
  EXPECT_THAT(warnings().at(0), HasSubstr("nearest to exit \"gate\""));
}

TEST_F(Outline, NamesEachOfSeveralGapsTheWidestFirst) {
  yard.obstacles = Yard::box(-11, -11, -10, -6) + Yard::box(-11, -3, -10, 11) +
                   Yard::box(-10, -11, 11, -10) + Yard::box(10, 1.5, 11, 11) +
                   Yard::box(10, -10, 11, -1.5) + Yard::box(-8, 4, -4, 8) +
                   Yard::box(-10, 10, 2, 11) + Yard::box(7, 10, 10, 11);
  const std::vector<NamedGap> found = gaps();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].width_m, 5, 0.11);
  EXPECT_LT((found[0].middle - Vector2d(4.5, 10.5)).norm(), 0.6);
  EXPECT_NEAR(found[1].width_m, 3, 0.11);
  EXPECT_LT((found[1].middle - Vector2d(-10.5, -4.5)).norm(), 0.6);
}

TEST_F(Outline, ATwoMeterPillarInAnOpeningMakesTwoGapsOfIt) {
  yard.obstacles = three_walls() + Yard::box(-10, 10, -2, 11) + Yard::box(-0.5, 10, 1.5, 11) +
                   Yard::box(4.5, 10, 10, 11);
  const std::vector<NamedGap> found = gaps();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].width_m, 3, 0.11);
  EXPECT_NEAR(found[1].width_m, 1.5, 0.11);
}

TEST_F(Outline, AGapThatNobodyFitsThroughIsNone) {
  yard.obstacles = three_walls() + Yard::box(-10, 10, 3, 11) + Yard::box(3.4, 10, 10, 11);
  EXPECT_THAT(warnings(), IsEmpty()) << "0.4 m for people of 0.5 m";
}

TEST_F(Outline, PillarsAndRoomsInsideAreNoGaps) {
  yard.obstacles = three_walls() + Yard::box(-10, 10, 3, 11) + Yard::box(6, 10, 10, 11) +
                   Yard::box(3, 7, 4, 8) + Yard::box(-10, 0, -5, 0.3);
  expect_gap({3, {4.5, 10.5}});
}

TEST_F(Outline, ADoorThatIsTooNarrowForItsOpeningLeavesGapsBesideIt) {
  yard.scenario["exits"][0]["from"] = {10, -0.5};
  yard.scenario["exits"][0]["to"] = {10, 0.5};
  const std::vector<NamedGap> found = gaps();
  ASSERT_EQ(found.size(), 2U) << "people pass 1 m beside the door on both sides";
  EXPECT_NEAR(found[0].width_m, 1, 0.11);
}

TEST_F(Outline, AClosedExitIsAWallOnlyWithAnObstacle) {
  yard.obstacles = three_walls() + Yard::box(-10, 10, 3, 11) + Yard::box(6, 10, 10, 11);
  yard.scenario["exits"].push_back(
      {{"id", "back"}, {"from", {3, 10}}, {"to", {6, 10}}, {"open", false}});
  EXPECT_THAT(warnings().at(0), HasSubstr("in exit \"back\", which is closed but has no obstacle"));
  yard.obstacles += Yard::box(3, 10, 6, 11);
  EXPECT_THAT(warnings(), IsEmpty());
  yard.obstacles = three_walls() + Yard::box(-10, 10, 3, 11) + Yard::box(6, 10, 10, 11);
  yard.scenario["exits"][1].erase("open");
  yard.scenario["exits"][1]["closes_at_s"] = 20;
  EXPECT_EQ(gaps().size(), 0U) << "an exit until then: it counts";
}

TEST_F(Outline, SaysThatAScenarioWithoutWallsIsOpen) {
  yard.obstacles = Yard::box(-8, 4, -4, 8);
  const std::vector<std::string> said = warnings();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said[0], HasSubstr("a scenario that walls do not close"));
}

/// A wall along one side of a square hall from -h to h, with a piece of it left out.
std::string wall_without(double h, int side, double middle, double width_m) {
  std::string boxes;
  for (const auto& [a, b] :
       {std::pair(-h - 1, middle - width_m / 2), {middle + width_m / 2, h + 1}}) {
    if (side == 0) boxes += Yard::box(a, -h - 1, b, -h);
    if (side == 1) boxes += Yard::box(h, a, h + 1, b);
    if (side == 2) boxes += Yard::box(a, h, b, h + 1);
    if (side == 3) boxes += Yard::box(-h - 1, a, -h, b);
  }
  return boxes;
}

TEST_F(Outline, FindsGapsOfAnySizeInAnyWallOfAnyHall) {
  Random random(7, Stream::place);
  for (int i = 0; i < 40; ++i) {
    const double half_m = random.uniform(6, 25);
    const int gap_side = static_cast<int>(random.below(4));
    const double width_m = random.uniform(0.9, half_m);
    const double middle = random.uniform(-0.4, 0.4) * half_m;
    const double gate = random.uniform(-0.6, 0.6) * half_m;
    // People stand in a corner; the gate is in the wall opposite of the gap, or around a corner.
    const int gate_side = (gap_side + 1 + i % 3) % 4;
    yard.obstacles.clear();
    for (int side = 0; side < 4; ++side) {
      if (side == gap_side) yard.obstacles += wall_without(half_m, side, middle, width_m);
      if (side == gate_side) yard.obstacles += wall_without(half_m, side, gate, 2);
      if (side != gap_side && side != gate_side) {
        yard.obstacles += wall_without(half_m, side, 0, 0);
      }
    }
    const auto on_side = [&](int side, double along, double depth_m) {
      const double out = half_m + depth_m;
      return std::vector<Vector2d>{{along, -out}, {out, along}, {along, out}, {-out, along}}.at(
          static_cast<std::size_t>(side));
    };
    const Vector2d from = on_side(gate_side, gate - 1, 0);
    const Vector2d to = on_side(gate_side, gate + 1, 0);
    yard.scenario["exits"][0]["from"] = {from.x(), from.y()};
    yard.scenario["exits"][0]["to"] = {to.x(), to.y()};
    const Vector2d goal = on_side(gate_side, gate, 4);
    yard.goals =
        fmt::format(R"(<GoalSet id="3"><Goal id="0" type="point" x="{}" y="{}"/></GoalSet>)",
                    goal.x(), goal.y());
    const double reach = half_m + 3;
    yard.scenario["inside"] = {{"min", {-reach, -reach}}, {"max", {reach, reach}}};
    yard.scenario["buildings"] = nlohmann::json::array();
    yard.generator = fmt::format(R"(<Generator type="rect_grid" anchor_x="{}" anchor_y="{}"
        offset_x="1" offset_y="1" count_x="3" count_y="4"/>)",
                                 -half_m + 1, -half_m + 1);
    const Vector2d expected = on_side(gap_side, middle, 0.5);
    const std::vector<NamedGap> found = gaps();
    ASSERT_EQ(found.size(), 1U) << "hall " << i;
    EXPECT_NEAR(found[0].width_m, width_m, 0.11) << "hall " << i;
    EXPECT_LT((found[0].middle - expected).norm(), 0.7) << "hall " << i;
  }
}

}  // namespace
}  // namespace throng::scenarios
