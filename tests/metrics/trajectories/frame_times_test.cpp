// Frame rates of tables whose times are rounded.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/files/files.h"
#include "metrics/trajectories/trajectory_file.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

constexpr double kStepM = 0.04;

world::Trace table_of_times(const std::string& text, std::optional<double> rate = std::nullopt,
                            std::vector<Problem>* notes = nullptr) {
  const testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "walk.csv", text);
  TrajectoryFormat format;
  format.frames_per_s = rate;
  return read_trajectory(folder.path() / "walk.csv", {}, format, notes);
}

bool every(int /*frame*/) { return true; }

/// A person who walks on by kStepM in each frame; times of frames k / rate are rounded to `digits`.
std::string rounded(double rate, int frames, int digits, double first_s = 0,
                    const std::function<bool(int)>& is_there = every, const char* name = "time") {
  const double per_unit = std::pow(10, digits);
  std::string text = fmt::format("id,{},x,y\n", name);
  for (int k = 0; k < frames; ++k) {
    if (!is_there(k)) continue;
    const double time_s = std::round((first_s + k / rate) * per_unit) / per_unit;
    text += fmt::format("1,{:.{}f},{:.4f},2\n", time_s, digits, kStepM * k);
  }
  return text;
}

/// Checks that each step of the trace is a frame of the file.
void expect_frames(const world::Trace& trace, double rate, std::size_t frames) {
  EXPECT_NEAR(1 / trace.header.dt_s, rate, 1e-6 * rate);
  ASSERT_EQ(trace.steps(), frames);
  for (std::size_t step = 0; step < frames; ++step) {
    if (!trace.present(step, 0)) continue;
    EXPECT_NEAR(trace.position[step].x(), kStepM * static_cast<double>(step), 1e-4) << step;
  }
}

TEST(FrameTimes, RoundedTimesHaveTheRateOfTheCamera) {
  for (const double rate :
       {7.5, 8.0, 12.5, 15.0, 16.0, 24.0, 25.0, 30.0, 33.0, 48.0, 50.0, 60.0, 75.0}) {
    for (const int digits : {2, 3, 6}) {
      SCOPED_TRACE(fmt::format("{} Hz, {} digits", rate, digits));
      expect_frames(table_of_times(rounded(rate, 300, digits)), rate, 300);
      expect_frames(table_of_times(rounded(rate, 300, digits, 1234.57)), rate, 300);
      expect_frames(table_of_times(rounded(rate, 300, digits), rate), rate, 300);
    }
  }
  expect_frames(table_of_times(rounded(4, 40, 1)), 4, 40);
  expect_frames(table_of_times(rounded(8, 40, 1)), 8, 40);
  expect_frames(table_of_times(rounded(30, 9, 2)), 30, 9);
  expect_frames(table_of_times(rounded(30, 200, 2, 1700000000.01)), 30, 200);
}

TEST(FrameTimes, RatesOfNtscAndUnusualOnesAreThoseThatRoundingAllows) {
  expect_frames(table_of_times(rounded(30000.0 / 1001, 600, 3)), 30000.0 / 1001, 600);
  expect_frames(table_of_times(rounded(24000.0 / 1001, 2000, 2)), 24000.0 / 1001, 2000);
  expect_frames(table_of_times(rounded(18, 200, 2)), 18, 200);
  expect_frames(table_of_times(rounded(31.25, 2000, 3)), 31.25, 2000);
  expect_frames(table_of_times(rounded(100.0 / 3, 90, 2)), 100.0 / 3, 90);
  const world::Trace slow = table_of_times(rounded(100.0 / 7 * 1.01, 700, 2));
  EXPECT_NEAR(1 / slow.header.dt_s, 100.0 / 7 * 1.01, 0.01);
  EXPECT_EQ(slow.steps(), 700U);
}

TEST(FrameTimes, MissingFramesAndPartsOfTheRows) {
  const auto has_gaps = [](int k) { return k % 7 != 3 && (k < 50 || k > 150); };
  expect_frames(table_of_times(rounded(30, 400, 2, 0.02, has_gaps)), 30, 400);
  expect_frames(table_of_times(rounded(60, 400, 2, 0, has_gaps)), 60, 400);
  expect_frames(table_of_times(rounded(24, 400, 2, 7.3, has_gaps)), 24, 400);
  const world::Trace third =
      table_of_times(rounded(24, 300, 2, 0, [](int k) { return k % 3 == 0; }));
  EXPECT_NEAR(1 / third.header.dt_s, 8, 1e-6);
  EXPECT_EQ(third.steps(), 100U);
  const auto mostly_missing = [](int k) { return k < 2 || k % 9 == 0 || k % 9 == 4 || k % 9 == 7; };
  expect_frames(table_of_times(rounded(20, 397, 3, 5, mostly_missing)), 20, 397);
}

TEST(FrameTimes, MillisecondsAndNoise) {
  std::string in_ms = "id,time [ms],x,y\n";
  std::string in_tens = in_ms;
  std::string noisy = "id,time,x,y\n";
  for (int k = 0; k < 200; ++k) {
    in_ms += fmt::format("1,{},{:.4f},2\n", std::lround(k * 1000 / 30.0), kStepM * k);
    in_tens += fmt::format("1,{},{:.4f},2\n", 10 * std::lround(k * 100 / 30.0), kStepM * k);
    const auto noise = static_cast<double>(static_cast<float>(1000 + k / 30.0));
    noisy += fmt::format("1,{:.17g},{:.4f},2\n", noise, kStepM * k);
  }
  for (const std::string& text : {in_ms, in_tens, noisy}) {
    expect_frames(table_of_times(text), 30, 200);
  }
}

TEST(FrameTimes, ClocksThatVaryHaveTheirMeanRateAndEventsNone) {
  std::string text = "id,time,x,y\n";
  std::string events = text;
  for (int k = 0; k < 300; ++k) {
    const double late_s = 0.001 * ((k * 7) % 5 - 2);
    text += fmt::format("1,{:.4f},{:.4f},2\n", k / 30.0 + late_s, kStepM * k);
    events += fmt::format("1,{:.4f},{:.4f},2\n", k / 30.0 + 0.03 * std::sin(k * k), kStepM * k);
  }
  std::vector<Problem> notes;
  EXPECT_NEAR(1 / table_of_times(text, std::nullopt, &notes).header.dt_s, 30, 1e-6);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].text().find("interpolated at 30 frames"), std::string::npos);
  table_of_times(rounded(30, 300, 2), std::nullopt, &notes);
  EXPECT_TRUE(notes.empty());
  EXPECT_THROW(table_of_times(events), InputError);
}

}  // namespace
}  // namespace throng::metrics
