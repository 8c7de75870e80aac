#include "world/stand_seats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "base/error.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"

namespace throng::world {
namespace {

using Eigen::Vector2d;
using nlohmann::json;
using throng::testing::TemporaryFolder;

/// 50 m along +x: the field lies at greater y, rows rise toward smaller y.
Stand main_stand() {
  Stand stand;
  stand.from = {10, 20};
  stand.to = {60, 20};
  stand.rows = 12;
  stand.front_height_m = 1.5;
  stand.row_depth_m = 0.8;
  stand.row_rise_m = 0.4;
  return stand;
}

TEST(StandSeats, TheFieldLiesOnTheLeftAndRowsRiseToTheRight) {
  const Stand stand = main_stand();
  EXPECT_TRUE(point_on(stand, 5, 2).isApprox(Vector2d(15, 18)));
  EXPECT_TRUE(frame_point(stand, {15, 18}).isApprox(Vector2d(5, 2)));
  EXPECT_NEAR(facing_rad(stand), std::numbers::pi / 2, 1e-12);
  EXPECT_DOUBLE_EQ(row_height_m(stand, 3), 1.5 + 3 * 0.4);
}

TEST(StandSeats, BlocksAreAsLongAsEachOtherBetweenAisles) {
  // 50 m: (50 - 1.2) / (11 + 1.2) = 4 blocks of 11 m and 5 aisles.
  const std::vector<Aisle> stairs = aisles(main_stand());
  ASSERT_EQ(stairs.size(), 5U);
  for (std::size_t i = 0; i < stairs.size(); ++i) {
    EXPECT_NEAR(stairs[i].along_m, 0.6 + 12.2 * static_cast<double>(i), 1e-9);
  }
  EXPECT_EQ(inner_aisles(main_stand()), 3U);
}

TEST(StandSeats, SeatsFillTheRowsBetweenAisles) {
  const Stand stand = main_stand();
  const std::vector<Seat> all = seats(stand);
  EXPECT_EQ(all.size(), 12U * 4 * 22);
  std::map<std::pair<int, int>, std::vector<double>> rows;
  for (const Seat& seat : all) {
    rows[{seat.row, seat.block}].push_back(seat.along_m);
    EXPECT_DOUBLE_EQ(seat.height_m, 1.5 + 0.4 * seat.row);
    // 0.25 m before the rear edge of the row.
    EXPECT_NEAR(seat.position.y(), 20 - 0.8 * (seat.row + 1) + 0.25, 1e-9);
    EXPECT_NEAR(seat.position.x(), 10 + seat.along_m, 1e-9);
    for (const Aisle& aisle : aisles(stand)) {
      EXPECT_GE(std::abs(seat.along_m - aisle.along_m), 0.6 + 0.25 - 1e-9);
    }
  }
  for (const auto& [place, along] : rows) {
    for (std::size_t i = 1; i < along.size(); ++i) EXPECT_NEAR(along[i] - along[i - 1], 0.5, 1e-9);
  }
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const Seat& a, const Seat& b) {
    return std::pair(a.row, a.along_m) < std::pair(b.row, b.along_m);
  }));
}

TEST(StandSeats, NoneWhereVomitoriesAre) {
  Stand stand = main_stand();
  stand.vomitories = 2;
  const std::vector<Vomitory> openings = vomitories(stand);
  ASSERT_EQ(openings.size(), 2U);
  EXPECT_EQ(openings[0].aisle, 1U);  // 12.5 m and 37.5 m, in the aisles at 12.8 m and 37.2 m
  EXPECT_EQ(openings[1].aisle, 3U);
  EXPECT_EQ(openings[0].first_row, 4);
  EXPECT_EQ(openings[0].end_row, 8);
  for (const Seat& seat : seats(stand)) {
    if (seat.row < 4 || seat.row >= 8) continue;
    for (const Vomitory& opening : openings) {
      EXPECT_GE(std::abs(seat.along_m - opening.along_m), 1.2 + 0.25 - 1e-9);
    }
  }
  // 0.6 m beside each aisle are two seats on each side in four rows.
  EXPECT_EQ(seats(stand).size(), 12U * 4 * 22 - 2U * 4 * 4);
  stand.rows = 6;
  EXPECT_EQ(vomitories(stand).front().end_row, 6);
}

TEST(StandSeats, AShortStandHasOneAisle) {
  Stand stand = main_stand();
  stand.to = {12, 20};
  EXPECT_EQ(aisles(stand).size(), 1U);
  EXPECT_EQ(seats(stand).size(), 12U);  // 0.8 m: one seat in each row
}

TEST(StandSeats, SpectatorsOfALargerCountContainThoseOfASmallerOne) {
  Stand stand = main_stand();
  const std::vector<Seat> all = seats(stand);
  stand.spectators = {100, 3};
  const std::vector<std::size_t> few = taken_seats(stand, all);
  stand.spectators.count = 400;
  const std::vector<std::size_t> many = taken_seats(stand, all);
  EXPECT_EQ(few.size(), 100U);
  EXPECT_EQ(std::set(few.begin(), few.end()).size(), 100U);
  EXPECT_TRUE(std::is_sorted(few.begin(), few.end()));
  EXPECT_TRUE(std::includes(many.begin(), many.end(), few.begin(), few.end()));
  stand.spectators.seed = 4;
  EXPECT_NE(taken_seats(stand, all), many);
}

TEST(StandSeats, SpectatorsSitInGroupsAndMoreInTheMiddle) {
  Stand stand = main_stand();
  const std::vector<Seat> all = seats(stand);
  stand.spectators = {static_cast<int>(all.size() / 5), 7};
  const std::vector<std::size_t> taken = taken_seats(stand, all);
  const double count = static_cast<double>(taken.size());
  double pairs = 0;  // with somebody on the next seat
  double in_the_middle = 0;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Seat& seat = all[taken[i]];
    in_the_middle += std::abs(seat.along_m / length_m(stand) - 0.5) < 0.25 ? 1 : 0;
    if (i + 1 == taken.size() || taken[i + 1] != taken[i] + 1) continue;
    pairs += all[taken[i + 1]].row == seat.row ? 1 : 0;
  }
  // By chance alone a fifth would have a neighbor on that side, and half would be in the middle.
  EXPECT_GT(pairs, 0.3 * count);
  EXPECT_GT(in_the_middle, 0.6 * count);
}

TEST(StandElevation, FollowsTreadsAislesAndTheStepsBeforeThem) {
  const std::vector<Stand> stands = {main_stand()};
  const auto at = [&](double along_m, double back_m) {
    return elevation_m(stands, point_on(stands[0], along_m, back_m));
  };
  EXPECT_DOUBLE_EQ(at(5, 0.01), 1.5);  // treads
  EXPECT_DOUBLE_EQ(at(5, 0.79), 1.5);
  EXPECT_DOUBLE_EQ(at(5, 0.81), 1.9);
  EXPECT_DOUBLE_EQ(at(5, 9.59), 1.5 + 11 * 0.4);
  EXPECT_NEAR(at(12.8, 0.4 + 0.8 * 3), 1.5 + 3 * 0.4, 1e-9);  // the middle of a tread
  EXPECT_NEAR(at(12.8, 0.8 * 3), 1.5 + 2.5 * 0.4, 1e-9);      // halfway between two
  EXPECT_NEAR(at(12.8, -0.3), 0.75, 1e-9);                    // halfway up the steps in front
  EXPECT_NEAR(at(12.8, -0.6), 0, 1e-9);
  EXPECT_DOUBLE_EQ(at(5, -0.3), 0);  // beside them
  EXPECT_DOUBLE_EQ(at(-0.1, 2), 0);
  EXPECT_DOUBLE_EQ(at(50.1, 2), 0);
  EXPECT_DOUBLE_EQ(at(5, 9.7), 0);
  for (const Seat& seat : seats(stands[0])) {
    EXPECT_DOUBLE_EQ(elevation_m(stands, seat.position), seat.height_m);
  }
}

json scenario_with(const json& stands) {
  return {{"name", "Ground"},
          {"ground", {{"min", {-80, -80}}, {"max", {80, 80}}, {"material", "grass"}}},
          {"inside", {{"min", {-80, -80}}, {"max", {80, 80}}}},
          {"exits", {{{"id", "a"}, {"from", {80, -1}}, {"to", {80, 1}}}}},
          {"stands", stands}};
}

std::vector<Problem> list_problems(const json& stands) {
  const TemporaryFolder folder;
  try {
    load_scenario(folder.write("ground.json", scenario_with(stands).dump()), "ground");
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

json stand_json(const char* id, int rows, int count) {
  return {{"id", id},
          {"from", {10, 20}},
          {"to", {60, 20}},
          {"rows", rows},
          {"spectators", {{"count", count}}}};
}

TEST(StandFields, SpectatorsNeedSeats) {
  EXPECT_TRUE(list_problems(json::array({stand_json("a", 12, 1056)})).empty());
  const std::vector<Problem> problems = list_problems(json::array({stand_json("a", 12, 1057)}));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/stands/0/spectators/count");
  EXPECT_EQ(problems[0].found, "1057");
  EXPECT_EQ(problems[0].expected, "at most 1056, its seats");
}

TEST(StandFields, AllStandsTogetherHaveAtMost20000Spectators) {
  json list = json::array();
  for (const char* id : {"a", "b", "c"}) list.push_back(stand_json(id, 80, 7000));
  const std::vector<Problem> problems = list_problems(list);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/stands/2/spectators/count");
}

TEST(StandFields, VomitoriesNeedAislesBetweenBlocks) {
  json stand = stand_json("a", 12, 0);
  stand["vomitories"] = 4;
  const std::vector<Problem> problems = list_problems(json::array({stand}));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/stands/0/vomitories");
}

TEST(StageDecks, CarryABandThatLooksAtTheAudience) {
  Prop prop;
  prop.kind = PropKind::bench;
  EXPECT_FALSE(stage_deck(prop).has_value());
  prop.kind = PropKind::main_stage;
  prop.position = {100, 50};
  prop.yaw_rad = std::numbers::pi / 2;  // its front, to the right, looks to +x
  const std::optional<Stand> deck = stage_deck(prop);
  ASSERT_TRUE(deck.has_value());
  EXPECT_NEAR(facing_rad(*deck), 0, 1e-9);
  const std::vector<Seat> places = seats(*deck);
  ASSERT_GE(places.size(), 4U);
  EXPECT_EQ(static_cast<std::size_t>(deck->spectators.count), places.size());
  for (const Seat& place : places) {
    EXPECT_LT(distance_to(prop, place.position), 1e-9);
    EXPECT_DOUBLE_EQ(elevation_m({&*deck, 1}, place.position), place.height_m);
    EXPECT_GE(place.height_m, 1.6);
  }
  EXPECT_EQ(elevation_m({&*deck, 1}, {130, 50}), 0);
}

}  // namespace
}  // namespace throng::world
