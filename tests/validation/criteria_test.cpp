// Criteria with measured values made by hand: both sides of every limit, and the text that is
// printed. Limits are those of RiMEA 4.1.1, NIST TN 1822 and docs/validation.md.
#include "validation/criteria.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace throng::validation::criteria {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

TEST(Rimea1, Takes26To34SecondsInside) {
  EXPECT_FALSE(corridor_time(25.9, true).passed);
  EXPECT_TRUE(corridor_time(26, true).passed);
  EXPECT_TRUE(corridor_time(34, true).passed);
  EXPECT_FALSE(corridor_time(34.1, true).passed);
  EXPECT_FALSE(corridor_time(30, false).passed);
  EXPECT_FALSE(corridor_time(0, true).passed) << "never arrived";
  EXPECT_EQ(corridor_time(30.06, true).measured, "30.1 s");
  EXPECT_EQ(corridor_time(30, false).measured, "30.0 s, left the corridor");
}

TEST(Nist21, AllowsFivePercent) {
  EXPECT_TRUE(corridor_speed(40).passed);
  EXPECT_TRUE(corridor_speed(38.1).passed);    // 1.0499 m/s
  EXPECT_FALSE(corridor_speed(38.09).passed);  // 1.0501 m/s
  EXPECT_TRUE(corridor_speed(42.1).passed);    // 0.950 m/s
  EXPECT_FALSE(corridor_speed(42.2).passed);   // 0.948 m/s
  EXPECT_FALSE(corridor_speed(0).passed) << "never arrived";
  EXPECT_EQ(corridor_speed(42.2).measured, "0.948 m/s");
}

TEST(Rimea4, NeedsSpeedsThatFall) {
  EXPECT_TRUE(falling_speeds({1.3, 1.0, 0.2}).passed);
  EXPECT_FALSE(falling_speeds({1.3, 1.3, 0.2}).passed);
  EXPECT_FALSE(falling_speeds({1.3, 0.2, 0.21}).passed);
  EXPECT_EQ(falling_speeds({1.3, 1.0, 0.204}).measured, "1.30 1.00 0.20 m/s");
}

TEST(Rimea5, ComparesEachWithTheirOwnTime) {
  EXPECT_TRUE(start_times({10, 20, 30}, true).passed);
  EXPECT_TRUE(start_times({10.5, 19.5, 30}, true).passed);
  EXPECT_FALSE(start_times({10, 20.6, 30}, true).passed);
  EXPECT_FALSE(start_times({9.4, 20, 30}, true).passed) << "too early";
  EXPECT_FALSE(start_times({20, 10, 30}, true).passed) << "in another order";
  EXPECT_FALSE(start_times({10, 20, 0}, true).passed) << "never started";
  EXPECT_FALSE(start_times({10, 20, 30}, false).passed);
  EXPECT_EQ(start_times({10, 20.3, 30}, false).measured, "0.3 s off, not all out");
}

TEST(Rimea6AndNist23, NeedEverybodyOutAndNobodyInAWall) {
  EXPECT_TRUE(corner_walk(59.9, 0, 60).passed);
  EXPECT_FALSE(corner_walk(60.0, 0, 60).passed);
  EXPECT_TRUE(corner_walk(250.0, 0, 1e9).passed) << "RiMEA limits no time";
  EXPECT_FALSE(corner_walk(20.0, 1, 60).passed);
  EXPECT_FALSE(corner_walk(std::nullopt, 0, 1e9).passed);
  EXPECT_EQ(corner_walk(std::nullopt, 3, 60).measured, "jams, 3 outside");
  EXPECT_EQ(corner_walk(21.26, 0, 60).measured, "21.3 s, 0 outside");
}

/// Four groups that pass: each within its range, means 1.1, 1.48, 1.0, 0.6.
std::vector<AgeSpeeds> good_ages() {
  return {{0.58, 1.61, {0.6, 1.6}},
          {1.41, 1.54, {1.45, 1.51}},
          {0.68, 1.41, {0.7, 1.3}},
          {0.46, 0.76, {0.5, 0.7}}};
}

TEST(Rimea7, AcceptsSpeedsOfTheirRanges) {
  const Verdict verdict = age_speeds(good_ages());
  EXPECT_TRUE(verdict.passed);
  EXPECT_EQ(verdict.measured, "0.60-1.60, 1.45-1.51, 0.70-1.30, 0.50-0.70 m/s");
}

TEST(Rimea7, AllowsThreeCentimetersPerSecondBeyondARange) {
  for (const auto& [speed, passes] : {std::pair(1.639, true), std::pair(1.641, false),
                                      std::pair(0.551, true), std::pair(0.549, false)}) {
    std::vector<AgeSpeeds> ages = good_ages();
    ages[0].measured_mps.push_back(speed);
    EXPECT_EQ(age_speeds(ages).passed, passes) << speed;
  }
}

TEST(Rimea7, NeedsMeansThatFallFromTheSecondGroupOn) {
  std::vector<AgeSpeeds> ages = good_ages();
  ages[2].measured_mps = {0.7};
  ages[3].measured_mps = {0.75};
  EXPECT_FALSE(age_speeds(ages).passed) << "the oldest are faster";
  ages = good_ages();
  ages[0].measured_mps = {0.6};
  EXPECT_TRUE(age_speeds(ages).passed) << "the first group, children, is not compared";
}

TEST(Rimea9, TakesAboutTwiceAsLongThroughHalfTheExits) {
  EXPECT_TRUE(exit_ratio(100, 200).passed);
  EXPECT_TRUE(exit_ratio(100, 160).passed);
  EXPECT_FALSE(exit_ratio(100, 159).passed);
  EXPECT_TRUE(exit_ratio(100, 240).passed);
  EXPECT_FALSE(exit_ratio(100, 241).passed);
  EXPECT_FALSE(exit_ratio(200, 100).passed) << "four and two exchanged";
  EXPECT_EQ(exit_ratio(100, 210).measured, "2.10 (100 s, 210 s)");
  EXPECT_FALSE(exit_ratio(std::nullopt, 200).passed);
  EXPECT_EQ(exit_ratio(100, std::nullopt).measured, "jams");
}

TEST(Rimea10, CountsPeoplePerExit) {
  EXPECT_TRUE(exit_assignment({15, 8}, {15, 8}).passed);
  EXPECT_FALSE(exit_assignment({8, 15}, {15, 8}).passed);
  EXPECT_FALSE(exit_assignment({15, 7}, {15, 8}).passed) << "one did not get out";
  EXPECT_EQ(exit_assignment({14, 9}, {15, 8}).measured, "14 of 15, 9 of 8");
}

TEST(Rimea11, ExpectsMostAtTheNearerExit) {
  EXPECT_TRUE(exit_shares({51, 49}, 100).passed);
  EXPECT_FALSE(exit_shares({50, 50}, 100).passed);
  EXPECT_FALSE(exit_shares({100, 0}, 100).passed) << "some take the other";
  EXPECT_FALSE(exit_shares({60, 39}, 100).passed) << "one is left";
  EXPECT_EQ(exit_shares({60, 30}, 100).measured, "67 % the nearer, 90 of 100 out");
  EXPECT_EQ(exit_shares({0, 0}, 100).measured, "0 % the nearer, 0 of 100 out");
}

TEST(Rimea12, ComparesTimes) {
  EXPECT_TRUE(ordered_times(80, 80, false).passed);
  EXPECT_FALSE(ordered_times(80, 80, true).passed);
  EXPECT_TRUE(ordered_times(80, 80.1, true).passed);
  EXPECT_FALSE(ordered_times(80.1, 80, false).passed);
  EXPECT_TRUE(ordered_times(80, kNever, true).passed);
  EXPECT_FALSE(ordered_times(kNever, kNever, false).passed) << "a jam is no success";
  EXPECT_EQ(ordered_times(80.04, kNever, true).measured, "80.0 s, jams");
}

TEST(Rimea12, WantsTheQueueBeforeTheFirstDoor) {
  EXPECT_TRUE(series_flow({0.1, 40, 5}).passed);
  EXPECT_TRUE(series_flow({-0.05, 40, 5}).passed);
  EXPECT_FALSE(series_flow({-0.06, 40, 5}).passed);
  EXPECT_FALSE(series_flow({0.1, 5, 5}).passed);
  EXPECT_EQ(series_flow({-kNever, 40, 5}).measured, "jams");
  EXPECT_FALSE(series_flow({-kNever, 40, 5}).passed);
  EXPECT_EQ(series_flow({0.1, 40, 5}).measured, "+0.10 /s, queues 40, 5");
}

TEST(Rimea12, WantsFlowThatGrowsWithWidth) {
  EXPECT_TRUE(growing_flows({1.0, 1.2, 1.5}).passed);
  EXPECT_FALSE(growing_flows({1.0, 1.0, 1.5}).passed);
  EXPECT_FALSE(growing_flows({1.0, 1.5, 1.4}).passed);
  EXPECT_FALSE(growing_flows({0, 1.2, 1.5}).passed) << "nobody gets through the narrowest";
  EXPECT_EQ(growing_flows({1, 1.2, 1.5}).measured, "1.00, 1.20, 1.50 /s");
}

TEST(Rimea15, WantsTheCornerBetweenTheTwoLengths) {
  EXPECT_TRUE(corner_times(60, 65, 70).passed);
  EXPECT_TRUE(corner_times(60, 60, 60).passed);
  EXPECT_FALSE(corner_times(66, 65, 70).passed);
  EXPECT_FALSE(corner_times(60, 71, 70).passed);
  EXPECT_EQ(corner_times(60, std::nullopt, 70).measured, "jams");
  EXPECT_EQ(corner_times(60.4, 65, 70).measured, "60, 65, 70 s");
}

TEST(Rimea16, ComparesWithTheSpeedOfTheHeadway) {
  // 26 people: headway 1 m, (1 - 0.36) / 1.06 = 0.604 m/s. 10: 2.13 m/s, limited to 1.34.
  EXPECT_TRUE(single_file_speeds({{26, 0.85, 0.6, 0.9}}).passed);
  EXPECT_FALSE(single_file_speeds({{26, 0.86, 0.6, 0.9}}).passed);
  EXPECT_TRUE(single_file_speeds({{26, 0.36, 0.3, 0.4}}).passed);
  EXPECT_FALSE(single_file_speeds({{26, 0.35, 0.3, 0.4}}).passed);
  EXPECT_TRUE(single_file_speeds({{10, 1.10, 0.8, 1.2}}).passed);
  EXPECT_FALSE(single_file_speeds({{10, 1.60, 0.8, 1.7}}).passed);
  // 80: headway 0.325 m, which is below 0.36: nobody moves.
  EXPECT_TRUE(single_file_speeds({{80, 0.2, 0.1, 0.3}}).passed);
}

TEST(Rimea16, WantsThreeQuartersAndTheOrderOfFreeSpeeds) {
  const FileSpeeds good = {26, 0.6, 0.5, 0.7};
  const FileSpeeds far = {26, 1.2, 0.5, 1.3};
  EXPECT_TRUE(single_file_speeds({good, good, good, far}).passed);
  EXPECT_FALSE(single_file_speeds({good, good, far, far}).passed);
  EXPECT_EQ(single_file_speeds({good, good, good, far}).measured,
            "0.60 0.60 0.60 1.20 m/s, 3 of 4 near");
  EXPECT_TRUE(single_file_speeds({{26, 0.6, 0.619, 0.581}}).passed) << "the same within 0.02 m/s";
  EXPECT_FALSE(single_file_speeds({{26, 0.6, 0.63, 0.7}}).passed);
  EXPECT_FALSE(single_file_speeds({{26, 0.6, 0.5, 0.57}}).passed);
  EXPECT_EQ(single_file_speeds({{26, 0.6, 0.63, 0.7}}).measured,
            "0.60 m/s, 1 of 1 near, not ordered by free speed");
}

/// Half of them slower than the mean, half faster, by the same: their sample deviation is
/// `spread` sqrt(100 / 99).
std::vector<double> two_speeds(double mean, double spread) {
  std::vector<double> speeds(100, mean - spread);
  for (std::size_t i = 0; i < 50; ++i) speeds[i] = mean + spread;
  return speeds;
}

TEST(Nist24, WantsMeanAndDeviation) {
  const double unit = std::sqrt(0.99);  // gives a sample deviation of 1
  EXPECT_TRUE(speed_distribution(two_speeds(1.2, 0.2 * unit)).passed);
  EXPECT_EQ(speed_distribution(two_speeds(1.2, 0.2 * unit)).measured, "1.20 ± 0.20 m/s");
  EXPECT_TRUE(speed_distribution(two_speeds(1.259, 0.2 * unit)).passed);
  EXPECT_FALSE(speed_distribution(two_speeds(1.261, 0.2 * unit)).passed);
  EXPECT_FALSE(speed_distribution(two_speeds(1.139, 0.2 * unit)).passed);
  EXPECT_TRUE(speed_distribution(two_speeds(1.2, 0.242 * unit)).passed);
  EXPECT_FALSE(speed_distribution(two_speeds(1.2, 0.244 * unit)).passed);
  EXPECT_FALSE(speed_distribution(two_speeds(1.2, 0.156 * unit)).passed);
  EXPECT_FALSE(speed_distribution(two_speeds(1.2, 0)).passed) << "all the same";
}

TEST(Nist28, WantsNoGrowth) {
  EXPECT_TRUE(falling_counts({100, 100, 60, 60}).passed);
  EXPECT_FALSE(falling_counts({100, 60, 61, 10}).passed);
  EXPECT_EQ(falling_counts({100, 60, 0}).measured, "100, 60, 0 across");
}

TEST(Nist41, WantsNobodyThroughTheClosedExit) {
  EXPECT_TRUE(closed_exit(5, 0, true).passed);
  EXPECT_FALSE(closed_exit(5, 1, true).passed);
  EXPECT_FALSE(closed_exit(0, 0, true).passed) << "it was never open";
  EXPECT_FALSE(closed_exit(5, 0, false).passed);
  EXPECT_EQ(closed_exit(5, 1, false).measured, "5 before, 1 after, not all out");
}

TEST(Nist51, WantsTheCrowdBeforeTheEntrance) {
  EXPECT_TRUE(congested_entrance(3, 2.9, true).passed);
  EXPECT_FALSE(congested_entrance(3, 3, true).passed);
  EXPECT_FALSE(congested_entrance(3, 2, false).passed);
  EXPECT_EQ(congested_entrance(3, 2.25, false).measured, "3.0, 2.2 /m², jams");
}

TEST(FundamentalDiagram, AllowsTwentyCentimetersPerSecond) {
  // Weidmann at 1 /m^2: 1.34 (1 - exp(-1.913 (1 - 1 / 5.4))) = 1.058 m/s; at 5.4: 0.
  EXPECT_TRUE(weidmann_diagram({{1, 1.25}, {5.4, 0.1}}).passed);
  EXPECT_FALSE(weidmann_diagram({{1, 1.27}, {5.4, 0.1}}).passed);
  EXPECT_FALSE(weidmann_diagram({{1, 0.85}, {5.4, 0.1}}).passed);
  EXPECT_EQ(weidmann_diagram({{1, 0.858}, {5.4, 0.1}}).measured, "-0.20 m/s at most");
  EXPECT_EQ(weidmann_diagram({{1, 1.0}, {5.4, 0.3}}).measured, "+0.30 m/s at most");
}

TEST(Doors, WantEverySpecificFlowInRange) {
  EXPECT_TRUE(specific_flows({1.2, 2.3}).passed);
  EXPECT_FALSE(specific_flows({1.19, 2}).passed);
  EXPECT_FALSE(specific_flows({1.5, 2.31}).passed);
  EXPECT_EQ(specific_flows({1.2, 2.3}).measured, "1.20 2.30 /(m s)");
}

TEST(Imo4, LimitsTheFastestRun) {
  EXPECT_TRUE(exit_flow({{true, 1.33, 0}, {true, 1, 0}}).passed);
  EXPECT_FALSE(exit_flow({{true, 1, 0}, {true, 1.34, 0}}).passed);
  EXPECT_FALSE(exit_flow({{true, 1.34, 0}, {true, 1, 0}}).passed);
  EXPECT_FALSE(exit_flow({{true, 1, 0}, {false, 0.5, 0}}).passed);
  EXPECT_EQ(exit_flow({{true, 1, 0}, {false, 1.25, 0}}).measured, "1.25 /s, jams");
}

TEST(CapacityDrop, WantsSeventyPercentAndAStandstill) {
  EXPECT_TRUE(capacity_drop(1.0, 0.69, 0.49).passed);
  EXPECT_FALSE(capacity_drop(1.0, 0.71, 0.49).passed);
  EXPECT_FALSE(capacity_drop(1.0, 0.69, 0.5).passed);
  EXPECT_FALSE(capacity_drop(0, 0, 0).passed) << "nobody moves at all";
  EXPECT_EQ(capacity_drop(1.0, 0.7, 0.5).measured, "1.00, 0.70, 0.50 /(m s)");
}

TEST(OpenSquare, LetsTwoPercentBeStuck) {
  EXPECT_TRUE(open_square(0.02, 0.02).passed);
  EXPECT_FALSE(open_square(0.03, 0).passed);
  EXPECT_FALSE(open_square(0, 0.03).passed);
  EXPECT_EQ(open_square(0.02, 0.1).measured, "2 %, 10 %");
}

TEST(CounterFlow, AllowsTwoAndAHalfTimesTheTime) {
  EXPECT_TRUE(counter_flow({100, 0}, {{250, 0}, {120, 0}}).passed);
  EXPECT_FALSE(counter_flow({100, 0}, {{120, 0}, {251, 0}}).passed);
  EXPECT_FALSE(counter_flow({100, 0}, {{120, 1}}).passed);
  EXPECT_FALSE(counter_flow({100, 1}, {{120, 0}}).passed);
  EXPECT_EQ(counter_flow({100, 0}, {{120, 1}, {240, 0}}).measured, "100, 240 s, jams");
}

TEST(TwoWay, LooksAtTheWorseDirectionOfTheWorstRun) {
  EXPECT_TRUE(two_way({{1, 0.75}, {0.8, 0.9}}, 1).passed);
  EXPECT_FALSE(two_way({{1, 0.74}, {0.8, 0.9}}, 1).passed);
  EXPECT_FALSE(two_way({{1, 1}, {0.74, 0.9}}, 1).passed);
  EXPECT_EQ(two_way({{1, 0.9, 0.01}, {0.8, 0.9}}, 1).measured, "0.80 /(m s), 1 % stuck");
}

TEST(TwoWay, AllowsTwoPercentWhoAreStuck) {
  EXPECT_TRUE(two_way({{1, 1, 0.02}, {1, 1}}, 1).passed);
  EXPECT_FALSE(two_way({{1, 1}, {1, 1, 0.03}}, 1).passed);
}

TEST(DrawnDoors, AreWithinFifteenPercentOfTheirMiddleAndGrow) {
  EXPECT_TRUE(drawn_doors({{0.9, 1.1}, {1.8, 2.2}}).passed);
  EXPECT_FALSE(drawn_doors({{0.8, 1.2}, {1.8, 2.2}}).passed);
  EXPECT_FALSE(drawn_doors({{1.8, 2.2}, {0.9, 1.1}}).passed) << "the wider one passes fewer";
  EXPECT_FALSE(drawn_doors({{0, 0}}).passed) << "nobody passes";
  EXPECT_EQ(drawn_doors({{0.9, 1.1}, {1.8, 2.2}}).measured, "1.00 /s ± 10 %, 2.00 /s ± 10 %");
}

TEST(Corner, KeepsEightyFivePercent) {
  EXPECT_TRUE(corner_flow({{1, 0.86, 0.86}, {2, 2, 2}}).passed);
  EXPECT_FALSE(corner_flow({{1, 0.84, 0.86}, {2, 2, 2}}).passed);
  EXPECT_FALSE(corner_flow({{1, 0.86, 0.84}, {2, 2, 2}}).passed) << "thin walls count too";
  EXPECT_FALSE(corner_flow({{1, 0.86, 0.86}, {2, 1, 2}}).passed);
  EXPECT_FALSE(corner_flow({{0, 0, 0}}).passed) << "a jam is no success";
  EXPECT_EQ(corner_flow({{1, 0.86, 0.9}, {2, 1, 1}}).measured,
            "1.00, 0.86, 0.90; 2.00, 1.00, 1.00 /(m s)");
}

TEST(Evasion, WantsAnEarlyGentleTurn) {
  EXPECT_TRUE(evasion({true, 2, 1}).passed);
  EXPECT_FALSE(evasion({true, 1.9, 1}).passed);
  EXPECT_FALSE(evasion({true, 2, 1.1}).passed);
  EXPECT_FALSE(evasion({false, 2, 1}).passed);
  EXPECT_EQ(evasion({false, 2, 1}).measured, "2.0 s, 1.0 m/s², they touch");
}

TEST(Queue, WantsFewTurnsAndSomePassage) {
  EXPECT_TRUE(queue({1, 0.9, 9}).passed);
  EXPECT_FALSE(queue({1, 1, 0}).passed);
  EXPECT_FALSE(queue({0, 0, 0}).passed) << "nobody passes";
  EXPECT_EQ(queue({3, 0.94, 2}).measured, "0.9 turns, 2.0 stops");
}

TEST(Criteria, CalmIsTheWorstOfAllScenes) {
  EXPECT_TRUE(calm({{0.9, 29, 0.02}, {0.1, 2, 0}}).passed);
  EXPECT_FALSE(calm({{0, 0, 0}, {1, 0, 0}}).passed);
  EXPECT_FALSE(calm({{0, 30, 0}}).passed);
  EXPECT_FALSE(calm({{0, 0, 0.021}}).passed);
  EXPECT_EQ(calm({{0.9, 3, 0.01}, {0.1, 29, 0.02}}).measured, "0.9 turns, 29°/s, 2.0 cm");
}

TEST(Criteria, CapacitiesAreTheSameWithinATenth) {
  EXPECT_TRUE(same_capacity({1.0, 1.1, 1.05}).passed);
  EXPECT_FALSE(same_capacity({1.0, 1.11}).passed);
  EXPECT_FALSE(same_capacity({0, 0}).passed) << "nobody walks";
}

}  // namespace
}  // namespace throng::validation::criteria
