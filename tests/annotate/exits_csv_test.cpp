#include "annotate/exits_csv.h"

#include <gtest/gtest.h>

#include <sstream>

namespace throng::annotate {
namespace {

std::vector<std::string> read_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Exits whose `crossed_out` tells the step.
std::vector<metrics::ExitSeries> two_exits(std::size_t steps) {
  std::vector<metrics::ExitSeries> exits(2);
  exits[0].exit_id = "north";
  exits[1].exit_id = "a \"b\", c";
  for (metrics::ExitSeries& exit : exits) {
    exit.samples.resize(steps);
    for (std::size_t i = 0; i < steps; ++i) exit.samples[i].crossed_out = static_cast<int>(i);
  }
  return exits;
}

TEST(ExitsCsv, HasARowPerFrameAndExit) {
  auto exits = two_exits(3);
  exits[0].samples[1] = {7,     1.25, 0.5,  0.75, 4, 1,   2.5, 0.3,  metrics::ExitState::congested,
                         0.625, 1.75, 1.25, true, 3, 2.5, 1.5, 0.02, metrics::ExitState::clogged};
  const std::vector<double> times = {0, 0.1, 0.2};
  const std::vector<FrameTime> frames = {{12, 0.1}};
  const auto lines = read_lines(exits_csv(exits, times, frames));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0],
            "frame,time_s,exit,in_zone,density,normalised_density,approach_speed,crossed_out,"
            "crossed_in,flow,"
            "since_crossing,state,clogging_index,voronoi_density,specific_flow,demand,queue,"
            "queue_length,predicted_wait,pressure,state_offline");
  EXPECT_EQ(lines[1],
            "12,0.1,north,7,1.2500,0.5000,0.7500,4,1,2.50,0.30,congested,0.6250,1.7500,1.250,1,3,"
            "2.50,1.50,0.02000,clogged");
  EXPECT_EQ(lines[2].substr(0, 26), "12,0.1,\"a \"\"b\"\", c\",0,0.00");
}

TEST(ExitsCsv, HasTimesWithoutErrorsOfRounding) {
  const std::vector<double> times = {0, 0.7};
  const std::vector<FrameTime> frames = {{7, 7 * 0.1}, {1, 1 / 3.0}};
  const auto lines = read_lines(exits_csv(two_exits(2), times, frames));
  EXPECT_EQ(lines[1].substr(0, 6), "7,0.7,");
  EXPECT_EQ(lines[3].substr(0, 11), "1,0.333333,");
}

TEST(ExitsCsv, TakesTheLastStepAtOrBeforeTheFrame) {
  std::vector<double> times;
  times.reserve(10);
  for (int i = 0; i < 10; ++i) times.push_back(i * 0.1);
  // 0.30000000000000004 is step 3; 3 * 0.1 and 0.3 differ in the last bit.
  const std::vector<FrameTime> frames = {{0, -1}, {1, 0}, {2, 0.3}, {3, 0.39}, {4, 99}};
  const auto lines = read_lines(exits_csv(two_exits(10), times, frames));
  ASSERT_EQ(lines.size(), 11U);
  const std::vector<std::string> crossed = {",0,0,", ",0,0,", ",3,0,", ",3,0,", ",9,0,"};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NE(lines[1 + 2 * i].find("0.0000" + crossed[i] + "0.00,"), std::string::npos)
        << lines[1 + 2 * i];
  }
}

TEST(ExitsCsv, IsOnlyAHeaderForAnEmptyRun) {
  const std::vector<FrameTime> frames = {{0, 0}};
  EXPECT_EQ(read_lines(exits_csv({}, {}, frames)).size(), 1U);
}

}  // namespace
}  // namespace throng::annotate
