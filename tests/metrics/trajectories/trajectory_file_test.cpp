#include "metrics/trajectories/trajectory_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <tuple>

#include "base/error.h"
#include "base/files/files.h"
#include "metrics/exits/exits.h"
#include "tests/metrics/walks.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

using testing::TemporaryFolder;

world::Trace read_text(const std::string& text) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "walk.txt", text);
  return read_trajectory(folder.path() / "walk.txt", {});
}

TEST(TrajectoryFile, ReadsThePedPyText) {
  const world::Trace trace = read_text(
      "# description: a walk\n# framerate: 16.00 fps\n# ID\tFR\tx/cm\ty/cm\tz/cm\n"
      "7 10 100 200 170\n7 11 110 200 170\n7 12 120 200 170\n9 12 0 0 0\n");
  ASSERT_EQ(trace.agents(), 2U);
  ASSERT_EQ(trace.steps(), 3U);
  EXPECT_DOUBLE_EQ(trace.header.dt_s, 1.0 / 16);
  EXPECT_TRUE(trace.present(0, 0));
  EXPECT_FALSE(trace.present(0, 1));
  EXPECT_TRUE(trace.present(2, 1));
  EXPECT_NEAR(trace.position[trace.at(1, 0)].x(), 1.1, 1e-6);
  for (std::size_t step = 0; step < 3; ++step) {
    EXPECT_NEAR(trace.velocity[trace.at(step, 0)].x(), 1.6, 1e-5);
  }
  EXPECT_EQ(trace.velocity[trace.at(2, 1)].norm(), 0);
}

std::filesystem::path write_gzip(const TemporaryFolder& folder, const std::string& name,
                                 const std::string& text) {
  const std::filesystem::path path = folder.path() / name;
  gzFile file = gzopen(path.c_str(), "wb");
  EXPECT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())),
            static_cast<int>(text.size()));
  EXPECT_EQ(gzclose(file), Z_OK);
  return path;
}

TEST(TrajectoryFile, ReadsCompressedTextAndTables) {
  const TemporaryFolder folder;
  const std::string lines = "1,0,100,200\n1,1,110,200\n";
  TrajectoryFormat format;
  format.frames_per_s = 10;
  for (const auto& [name, text] : {std::pair("a.txt.gz", "# x/cm\n" + lines),
                                   std::pair("a.csv.gz", "id,frame,x,y\n" + lines)}) {
    format.unit_m = 0.01;
    const world::Trace trace = read_trajectory(write_gzip(folder, name, text), {}, format);
    ASSERT_EQ(trace.steps(), 2U) << name;
    EXPECT_NEAR(trace.position[1].x(), 1.1, 1e-6) << name;
  }
  for (const char* name : {"a.scb.gz", "a.sqlite.gz"}) {
    const auto file = write_gzip(folder, name, "SQLite format 3 and more");
    EXPECT_THROW(read_trajectory(file, {}, format), InputError) << name;
  }
}

class TrajectoryRoundTrip : public ::testing::TestWithParam<const char*> {};

TEST_P(TrajectoryRoundTrip, KeepsTheValuesOfTheFormat) {
  std::vector<Walk> walks = {walking({-2, 0}, {1, 0}), walking({-3, 0.3}, {1, 0})};
  world::Trace trace = make_trace(walks);
  trace.header.exit_ids.clear();
  for (std::size_t step = 0; step < 5; ++step) trace.flags[trace.at(step, 1)] = 0;
  const TemporaryFolder folder;
  const auto file = folder.path() / GetParam();
  write_trajectory(trace, file);
  WalkerDefaults walkers;
  walkers.desired_speed_mps = 1.3;
  const world::Trace again = read_trajectory(file, walkers);
  EXPECT_EQ(again.steps(), trace.steps());
  EXPECT_EQ(again.flags, trace.flags);
  EXPECT_NEAR(again.header.dt_s, 0.1, 1e-12);
  for (std::size_t i = 0; i < trace.position.size(); ++i) {
    if (trace.flags[i] == 0) continue;
    EXPECT_NEAR((again.position[i] - trace.position[i]).norm(), 0, 1e-6);
    EXPECT_NEAR((again.velocity[i] - trace.velocity[i]).norm(), 0, 1e-3);
  }
  const world::Scenario scenario = place_with_door(2);
  const auto expected = exit_series(trace, scenario).at(0).samples;
  const auto measured = exit_series(again, scenario).at(0).samples;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(measured[i].crossed_out, expected[i].crossed_out);
    EXPECT_NEAR(measured[i].voronoi_density_per_m2, expected[i].voronoi_density_per_m2, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, TrajectoryRoundTrip,
                         ::testing::Values("walk.txt", "walk.sqlite", "walk.scb"));

TEST(TrajectoryFile, FindsRateAndUnitInCommentsOfAllKinds) {
  const TemporaryFolder folder;
  for (const auto& [comments, dt_s, unit] :
       {std::tuple("# framerate: 25 fps\n# id frame x/m y/m z/m\n", 0.04, 1.0),
        std::tuple("#framerate:\t16.00\n#ID\tFR\tX\tY\tZ\n", 0.0625, 1.0),
        std::tuple("# PeTrack project: 040_fps.pet\n# 25fps\n# x/cm y/cm z/cm\n", 0.04, 0.01),
        std::tuple("# frame rate = 10\n# coordinates in cm\n# z: height in m\n", 0.1, 0.01)}) {
    write_file_atomically(folder.path() / "w.txt",
                          std::string(comments) + "1\t0\t10\t0\t0\n1\t1\t10.5\t0\t0\n");
    const world::Trace trace = read_trajectory(folder.path() / "w.txt", {});
    EXPECT_NEAR(trace.header.dt_s, dt_s, 1e-9) << comments;
    EXPECT_NEAR(trace.position[0].x(), 10 * unit, 1e-4) << comments;
  }
}

TEST(TrajectoryFile, SaysWhichLineIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"# framerate: 10\n1 0 0 0\n1 1 zero 0\n", "line 3"},
      {"# framerate: 10\n1 0 0\n", "line 2"},
      {"# framerate: 10\n1 0.5 0 0\n", "line 2"},
      {"# framerate: 10\n1 0 0 0\n1 0 0 0\n", "line 3"},
      {"1 0 0 0\n", ""},
      {"# framerate: 10\n", ""},
      {"SQLite format 3 but no more", ""}};
  for (const auto& [text, where] : cases) {
    try {
      read_text(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().at(0).where, where) << text;
    }
  }
}

}  // namespace
}  // namespace throng::metrics
