// Tables of trajectories: columns by name, frames or times, and what is refused.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files/files.h"
#include "metrics/trajectories/trajectory_file.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

using throng::testing::TemporaryFolder;

world::Trace table(const std::string& text, const TrajectoryFormat& format,
                   const std::string& name = "walk.csv") {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / name, text);
  return read_trajectory(folder.path() / name, {}, format);
}

TrajectoryFormat by_frames(double rate) {
  TrajectoryFormat format;
  format.frames_per_s = rate;
  return format;
}

TEST(TrajectoryCsv, FindsItsColumnsByName) {
  TrajectoryFormat format = by_frames(10);
  format.unit_m = 0.01;
  format.columns = {"Person", "Frame no", "", "PosX", "PosY"};
  const world::Trace trace = table(
      "# an experiment\n\"Frame no\";PosY;extra;PosX;\"Person\"\n"
      "4;200;;100;anna\n5;200;;110;anna\n5;0;;0;\"Bert; jun.\"\n",
      format);
  ASSERT_EQ(trace.agents(), 2U);
  ASSERT_EQ(trace.steps(), 2U);
  EXPECT_NEAR(trace.position[trace.at(0, 0)].x(), 1.0, 1e-6);
  EXPECT_NEAR(trace.position[trace.at(1, 0)].x(), 1.1, 1e-6);
  EXPECT_NEAR(trace.position[trace.at(0, 0)].y(), 2.0, 1e-6);
  EXPECT_FALSE(trace.present(0, 1));
  EXPECT_TRUE(trace.present(1, 1));
}

TEST(TrajectoryCsv, PutsTimesOnFrames) {
  TrajectoryFormat format;
  format.columns.time = std::string("t");  // GCC bug 105651 (-Wrestrict) without it
  // A place every 0.1 s but for one that is late, and a gap of two seconds.
  const world::Trace trace = table(
      "id,t,x,y\n1,0,0,0\n1,0.1,1,0\n1,0.2,2,0\n1,0.35,3.5,0\n1,0.4,4,0\n1,2.4,4,0\n1,2.5,4,0\n",
      format);
  EXPECT_NEAR(trace.header.dt_s, 0.1, 1e-9);
  ASSERT_EQ(trace.steps(), 26U);
  EXPECT_NEAR(trace.position[3].x(), 3, 1e-5);
  EXPECT_TRUE(trace.present(4, 0));
  EXPECT_FALSE(trace.present(5, 0));
  EXPECT_FALSE(trace.present(23, 0));
  EXPECT_TRUE(trace.present(24, 0));
  format.frames_per_s = 20;
  EXPECT_NEAR(table("id,t,x,y\n1,0,0,0\n1,0.1,1,0\n", format).position[1].x(), 0.5, 1e-6);
}

TEST(TrajectoryCsv, KnowsOtherNamesUnitsAndComments) {
  const std::string mark = "\xEF\xBB\xBF";
  const world::Trace trace =
      table(mark + "# recorded at 10 fps\nPed_ID,FrameNumber,X [cm],Y [cm]\n7,3,100,250\n", {});
  EXPECT_NEAR(trace.header.dt_s, 0.1, 1e-9);
  EXPECT_NEAR(trace.position[0].x(), 1, 1e-6);
  EXPECT_NEAR(trace.position[0].y(), 2.5, 1e-6);
  const world::Trace timed = table("agent_id;Time;pos_x;pos_y\n1;0;0;0\n1;0.5;1;0\n", {});
  EXPECT_NEAR(timed.header.dt_s, 0.5, 1e-9);
  const world::Trace blanks = table("# framerate: 16\nID FR X Y Z\n1 0 3.5 1 0\n", {}, "walk.txt");
  EXPECT_NEAR(blanks.position[0].x(), 3.5, 1e-6);
}

// obsmat.txt of ETH's BIWI data: frame, person, x, z, y and velocities, a line in ten frames.
TEST(TrajectoryCsv, CountsColumnsOfTablesWithoutNames) {
  TrajectoryFormat format = by_frames(25);
  format.kind = TrajectoryKind::csv;
  format.columns = {"2", "1", "", "3", "5"};
  const world::Trace trace = table(
      "   7.8000000e+02   1.0000000e+00   8.4568443e+00   0.0   3.5880664e+00  1.6 0.0 0.1\n"
      "   7.9000000e+02   1.0000000e+00  +9.1256443e+00   0.0   3.6588664e+00  1.6 0.0 0.1\n"
      "   8.0000000e+02   2.0000000e+00   9.7000000e+00   0.0   3.7000000e+00  1.6 0.0 0.1\n",
      format, "obsmat.txt");
  ASSERT_EQ(trace.agents(), 2U);
  ASSERT_EQ(trace.steps(), 3U);  // each tenth frame is a step
  EXPECT_NEAR(trace.header.dt_s, 0.4, 1e-9);
  EXPECT_NEAR(trace.position[trace.at(0, 0)].y(), 3.5880664, 1e-5);
  EXPECT_NEAR(trace.velocity[trace.at(0, 0)].x(), (9.1256443 - 8.4568443) / 0.4, 1e-4);
}

TEST(TrajectoryCsv, ReportsMistakes) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"id,frame,x\n1,0,0\n", "line 1"},
      {"id,frame,x,y\n1,0,0\n", "line 2"},
      {"id,frame,x,y\n1,0,nan,0\n", "line 2"},
      {"id,frame,x,y\n1,0.5,0,0\n", "line 2"},
      {"id,frame,x,y\n1,1e30,0,0\n", "line 2"},
      {"id,frame,x,y\n,1,0,0\n", "line 2"},
      {"id,frame,x,y\n1,1,0,0\n1,1,0,0\n", "line 3"},
      {"id,frame,x,y\n1,1,1e9,0\n", "person 1, frame 1"},
      {"", ""}};
  for (const auto& [text, where] : cases) {
    try {
      table(text, by_frames(10));
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().at(0).where, where) << text;
    }
  }
  EXPECT_THROW(table("id,frame,x,y\n1,0,0,0\n", {}), InputError);
}

TEST(TrajectoryFile, RefusesFilesTooLargeForMemory) {
  std::string text = "# framerate: 10\n";
  for (int person = 1; person <= 5; ++person) {
    text += fmt::format("{0} 0 0 0\n{0} 9999999 0 0\n", person);
  }
  EXPECT_THROW(table(text, {}, "walk.txt"), InputError);
  EXPECT_THROW(table("# framerate: 1e-9\n1 0 0 0\n", {}, "walk.txt"), InputError);
  EXPECT_THROW(table("# framerate: 10\n1e300 0 0 0\n", {}, "walk.txt"), InputError);
}

}  // namespace
}  // namespace throng::metrics
