// The tables that say what a crowd did.
#include "crowd/output/series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "base/compute/random.h"
#include "crowd/output/csv.h"
#include "crowd/output/pair_distances.h"
#include "crowd/output/positions.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using testing::ElementsAre;
using testing::StartsWith;

std::vector<std::string> read_lines(const std::filesystem::path& path) {
  std::istringstream in(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> split_fields(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

/// Four agents around the origin: state Start until 0.95 s, then Stop, which is final.
Simulation four_agents(double time_step_s = 0.1) {
  return test::load(
      test::scene_with(agent_at(3, 0) + agent_at(-3, 0) + agent_at(0, 1) + agent_at(0, 1.3),
                       R"(r="0.2" pref_speed="1" max_accel="1000")", "Start", "", time_step_s),
      R"(<BFSM>
  <State name="Start" final="0"><VelComponent type="const_dir" x="1" y="0"/></State>
  <State name="Stop, all" final="1"/>
  <Transition from="Start" to="Stop, all">
    <Condition type="timer" per_agent="1" dist="c" value="0.95"/></Transition>
</BFSM>)");
}

std::vector<std::string> record_series(Simulation crowd, int steps) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("series.csv", "");
  SeriesWriter series(path, crowd);
  series.record(crowd);
  for (int i = 0; i < steps; ++i) {
    crowd.step();
    series.record(crowd);
  }
  series.finish(crowd);
  return read_lines(path);
}

TEST(Series, HasTheColumnsOfTheReferenceFiles) {
  const std::vector<std::string> lines = record_series(four_agents(), 0);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0],
            "time,frac_final_state,frac_terminal_state,mean_speed,max_speed,min_pair_dist,"
            "overlapping_pairs,mean_x,mean_y,std_x,std_y,n_Start,\"n_Stop, all\"");
  // std is the population's: sqrt((9 + 9 + 0 + 0) / 4).
  EXPECT_EQ(lines[1],
            "0.0000,0.0000,0.0000,0.0000,0.0000,0.3000,1,0.0000,0.5750,2.1213,0.5847,4,0");
}

TEST(Series, HasALineForEverySecondAndOneForTheEnd) {
  const std::vector<std::string> lines = record_series(four_agents(), 15);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_THAT(lines[1], StartsWith("0.0000,0.0000,"));
  EXPECT_THAT(lines[2], StartsWith("1.0000,0.0000,0.0000,"));
  EXPECT_THAT(lines[3], StartsWith("1.5000,1.0000,1.0000,"));
  EXPECT_EQ(split_fields(lines[3])[12], "4");
  // The end may be a whole second, too.
  EXPECT_EQ(record_series(four_agents(), 20).size(), 4U);
}

TEST(Series, TakesTheFrameNearestToASecond) {
  const std::vector<std::string> lines = record_series(four_agents(0.3), 10);
  std::vector<std::string> times;
  for (const std::string& line : lines) times.push_back(split_fields(line)[0]);
  EXPECT_THAT(times, ElementsAre("time", "0.0000", "0.9000", "2.1000", "3.0000"));
  EXPECT_EQ(record_series(four_agents(2.5), 3).size(), 5U);
}

TEST(Series, LeavesOutAbsentAgents) {
  Simulation crowd = four_agents();
  crowd.set_present(3, false);
  const std::vector<std::string> fields = split_fields(record_series(std::move(crowd), 0)[1]);
  EXPECT_EQ(fields[5], "3.1623");
  EXPECT_EQ(fields[6], "0");
  EXPECT_EQ(fields[11], "3");

  Simulation nobody = four_agents();
  for (std::size_t i = 0; i < 4; ++i) nobody.set_present(i, false);
  EXPECT_THAT(record_series(std::move(nobody), 0)[1],
              StartsWith("0.0000,nan,nan,nan,nan,nan,0,nan"));
}

std::vector<std::string> recorded_positions(int steps,
                                            const std::optional<std::vector<double>>& times_s) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("positions.csv", "");
  Simulation crowd = four_agents();
  {
    PositionsWriter positions(path, times_s, crowd);
    positions.record(crowd);
    for (int i = 0; i < steps; ++i) {
      crowd.step();
      positions.record(crowd);
    }
    positions.finish(crowd);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1)
      << "what was kept meanwhile is gone";
  return read_lines(path);
}

std::vector<std::string> time_column(const std::vector<std::string>& lines) {
  std::vector<std::string> times;
  for (const std::string& line : lines) {
    const std::string time = split_fields(line)[0];
    if (times.empty() || times.back() != time) times.push_back(time);
  }
  return times;
}

TEST(Positions, AreThoseOfSharesOfTheRun) {
  const std::vector<std::string> lines = recorded_positions(318, std::nullopt);
  // As in the reference files: halves of frames go to the even one.
  EXPECT_THAT(time_column(lines),
              ElementsAre("time", "0.0000", "3.2000", "8.0000", "15.9000", "23.8000", "31.8000"));
  ASSERT_EQ(lines.size(), 1 + 6 * 4U);
  EXPECT_EQ(lines[0], "time,agent,class,state,x,y,orient_rad,vpref_x,vpref_y,vx,vy");
  EXPECT_EQ(lines[2], "0.0000,1,0,Start,-3.00000,0.00000,0.00000,1.00000,0.00000,0.00000,0.00000");
  EXPECT_THAT(lines.back(), StartsWith("31.8000,3,0,\"Stop, all\","));
}

TEST(Positions, AreThoseOfGivenTimes) {
  EXPECT_THAT(time_column(recorded_positions(20, {{1.5, 0.52, 1.5, 100}})),
              ElementsAre("time", "0.5000", "1.5000"));
  EXPECT_THAT(time_column(recorded_positions(0, std::nullopt)), ElementsAre("time", "0.0000"));
}

TEST(PairDistances, AreThoseOfAllPairs) {
  PairDistancesMeter meter;
  for (std::uint64_t round = 0; round < 200; ++round) {
    Random random(round, Stream::sensors);
    const std::size_t count = random.below(60);
    const double side_m = std::pow(10.0, random.uniform(-1, 4));
    std::vector<Eigen::Vector2f> places;
    std::vector<float> radii;
    std::vector<std::uint8_t> present;
    for (std::size_t i = 0; i < count; ++i) {
      places.emplace_back(random.uniform(-side_m, side_m), random.uniform(-side_m, side_m));
      radii.push_back(static_cast<float>(random.uniform(0.1, 0.6)));
      present.push_back(random.below(10) > 0 ? 1 : 0);
    }
    double nearest_m = INFINITY;
    std::size_t overlapping = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (present[i] == 0 || present[j] == 0) continue;
        const double distance_m = (places[i].cast<double>() - places[j].cast<double>()).norm();
        nearest_m = std::min(nearest_m, distance_m);
        if (distance_m < kTouching * (double{radii[i]} + radii[j])) ++overlapping;
      }
    }
    const PairDistances found = meter.measure(places, radii, present);
    EXPECT_EQ(std::isnan(found.nearest_m) ? INFINITY : found.nearest_m, nearest_m) << round;
    EXPECT_EQ(found.overlapping, overlapping) << round;
  }
}

TEST(PairDistances, LeaveOutNaN) {
  PairDistancesMeter meter;
  const std::vector<Eigen::Vector2f> places = {{0, 0}, {NAN, 0}, {0, INFINITY}, {3, 4}};
  const PairDistances found =
      meter.measure(places, std::vector<float>(4, 0.2F), std::vector<std::uint8_t>(4, 1));
  EXPECT_EQ(found.nearest_m, 5);
}

TEST(Csv, QuotesFieldsThatNeedQuotes) {
  EXPECT_EQ(csv_text("plain"), "plain");
  EXPECT_EQ(csv_text("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_text("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(csv_number(-NAN, 4), "nan");
  EXPECT_EQ(csv_number(1.25, 1), "1.2");
}

}  // namespace
}  // namespace throng::crowd
