// Files as other programs write them: Pathfinder, Crowd:it, Vadere, Viswalk, SUMO, TrajNet++,
// spreadsheets, and tables whose first column is the frame.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files/files.h"
#include "metrics/trajectories/trajectory_file.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

using ::testing::HasSubstr;

world::Trace read(const std::string& text, const std::string& name,
                  const TrajectoryFormat& format = {}) {
  const testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / name, text);
  return read_trajectory(folder.path() / name, {}, format);
}

std::string refusal(const std::string& text, const std::string& name,
                    const TrajectoryFormat& format = {}) {
  try {
    read(text, name, format);
  } catch (const InputError& error) {
    return error.problems().at(0).text();
  }
  ADD_FAILURE() << "accepted:\n" << text;
  return "";
}

TrajectoryFormat at_rate(double rate) {
  TrajectoryFormat format;
  format.frames_per_s = rate;
  return format;
}

float x_at(const world::Trace& trace, std::size_t step, std::size_t person) {
  return trace.position[trace.at(step, person)].x();
}

TEST(ForeignFiles, PathfindersUnitsAreNoPerson) {
  const auto file = [](const std::string& unit) {
    return "\"t\",\"id\",\"name\",\"x\",\"y\"\n\"s\",\"\",\"\",\"" + unit + "\",\"" + unit +
           "\"\n0.0,7,\"0007\",1.0,2.0\n0.0,9,\"0009\",1.0,3.0\n0.2,7,\"0007\",1.25,2.0\n";
  };
  const world::Trace trace = read(file("m"), "p.csv");
  ASSERT_EQ(trace.agents(), 2U);
  EXPECT_NEAR(trace.header.dt_s, 0.2, 1e-9);
  EXPECT_NEAR(x_at(trace, 1, 0), 1.25, 1e-6);
  EXPECT_NEAR(x_at(read(file("ft"), "p.csv"), 1, 0), 1.25 * 0.3048, 1e-6);
  EXPECT_THAT(refusal(file("furlong"), "p.csv"), HasSubstr("--unit-m"));
}

TEST(ForeignFiles, PathfindersJson) {
  const world::Trace trace = read(
      R"({"3": {"0.0": {"position": {"x": 1, "y": 2, "z": 0}}, "0.5": {"position": {"x": 2, "y": 2}}},
          "4": {"0.5": {"position": {"x": 5, "y": 5}}}})",
      "p.json");
  ASSERT_EQ(trace.agents(), 2U);
  EXPECT_NEAR(trace.header.dt_s, 0.5, 1e-9);
  EXPECT_NEAR(x_at(trace, 1, 0), 2, 1e-6);
  EXPECT_FALSE(trace.present(0, 1));
  EXPECT_THAT(refusal(R"({"3": {"0.0": {"position": {"x": "far"}}}})", "p.json"),
              HasSubstr("/3/0.0/position"));
}

TEST(ForeignFiles, CrowditsEmptyPlacesAreAbsences) {
  const world::Trace trace =
      read("time,pedID,posX,posY\n0.0,0,1,2\n0.0,1,,\n0.5,0,1.5,2\n0.5,1,3,3\n", "c.csv");
  ASSERT_EQ(trace.agents(), 2U);
  EXPECT_FALSE(trace.present(0, 1));
  EXPECT_NEAR(x_at(trace, 1, 1), 3, 1e-6);
}

TEST(ForeignFiles, VaderesFootstepsNeedARateAndSpanPauses) {
  const std::string steps =
      "#IDXCOL=2,DATACOL=6,SEP=' '\n"
      "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1 "
      "targetId-PID2\n"
      "1 0.0 0.53 0 0 0.7 0 8\n2 0.31 0.9 0 1 0.7 1 8\n1 0.53 1.17 0.7 0 1.4 0 8\n"
      "2 0.95 1.4 0.7 1 1.4 1 8\n1 1.17 4.4 1.4 0 1.4 0 8\n1 4.61 5 1.4 0 2.1 0 8\n";
  EXPECT_THAT(refusal(steps, "postvis.traj"), HasSubstr("--frame-rate"));
  const world::Trace trace = read(steps, "postvis.traj", at_rate(10));
  ASSERT_EQ(trace.agents(), 2U);
  EXPECT_TRUE(trace.present(30, 0)) << "stands from 1.17 to 4.61 s";
  EXPECT_NEAR(x_at(trace, 1, 0), 0.7 * 0.1 / 0.53, 1e-5);
  const std::string grid =
      "pedestrianId simTime startX-PID1 startY-PID1\n1 0.4 0 0\n1 0.8 0.5 0\n1 1.2 1 0\n";
  EXPECT_NEAR(read(grid, "v.traj").header.dt_s, 0.4, 1e-9);
}

TEST(ForeignFiles, ViswalksCommentsAndNames) {
  const auto file = [](const std::string& unit) {
    return "$VISION\n* File: C:\\a 25 fps b.inpx\n* SIMSEC: SimSec, Simulation second [s]\n"
           "* COORDCENTX: CoordCentX, Coordinate center (x) [" +
           unit +
           "]\n*\n$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY\n1;0.20;1.0;2.0\n1;0.40;1.1;2.0\n"
           "2;0.40;5.0;2.0\n";
  };
  const world::Trace trace = read("\xEF\xBB\xBF" + file("m"), "walk.pp");
  ASSERT_EQ(trace.agents(), 2U);
  EXPECT_NEAR(trace.header.dt_s, 0.2, 1e-9);
  EXPECT_NEAR(x_at(trace, 1, 0), 1.1, 1e-6);
  EXPECT_NEAR(x_at(read(file("ft"), "walk.pp"), 1, 0), 1.1 * 0.3048, 1e-6);
}

TEST(ForeignFiles, SumosTableHasPersonsBesideVehicles) {
  const world::Trace trace = read(
      "timestep_time;vehicle_id;vehicle_x;vehicle_y;person_id;person_speed;person_x;person_y\n"
      "0.00;car;8.0;9.0;;;;\n0.00;;;;p0;1.2;10.0;5.0\n1.00;;;;p0;1.2;11.2;5.0\n"
      "1.00;car;9.0;9.0;;;;\n",
      "fcd.csv");
  ASSERT_EQ(trace.agents(), 1U);
  ASSERT_EQ(trace.steps(), 2U);
  EXPECT_NEAR(trace.header.dt_s, 1, 1e-9);
  EXPECT_NEAR(x_at(trace, 1, 0), 11.2, 1e-5);
}

TEST(ForeignFiles, TracksOfDronesHaveCenters) {
  const world::Trace trace = read(
      "recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading\n"
      "0,7,100,0,1.0,-2.0,90\n0,7,101,1,1.1,-2.0,90\n",
      "00_tracks.csv", at_rate(25));
  ASSERT_EQ(trace.agents(), 1U);
  EXPECT_NEAR(x_at(trace, 1, 0), 1.1, 1e-6);
}

TEST(ForeignFiles, SumosPersonsButNoVehicles) {
  const auto file = [](double step_m) {
    std::string text = "<?xml version=\"1.0\"?>\n<fcd-export>\n";
    for (int i = 0; i < 3; ++i) {
      text += fmt::format(
          "<timestep time=\"{}.00\"><vehicle id=\"v\" x=\"0\" y=\"0\" speed=\"9\"/>"
          "<person id=\"p.{}\" x=\"{}\" y=\"5\" angle=\"90\" speed=\"1.2\"/></timestep>\n",
          i, 0, 10 + i * step_m);
    }
    return text + "</fcd-export>\n";
  };
  const world::Trace trace = read(file(1.2), "fcd.xml");
  ASSERT_EQ(trace.agents(), 1U);
  ASSERT_EQ(trace.steps(), 3U);
  EXPECT_NEAR(trace.header.dt_s, 1, 1e-9);
  EXPECT_NEAR(x_at(trace, 2, 0), 12.4, 1e-5);
  EXPECT_THAT(refusal(file(1e-5), "fcd.xml"), HasSubstr("--fcd-output.geo"));
  EXPECT_THAT(refusal("<fcd-export><timestep time=\"0\"><vehicle id=\"v\" x=\"0\" y=\"0\"/>"
                      "</timestep></fcd-export>",
                      "fcd.xml"),
              HasSubstr("<person>"));
  EXPECT_THAT(
      refusal("<fcd-export>\n<timestep time=\"0\"><person id=\"p\" x=\"a\" y=\"0\"/>", "f.xml"),
      HasSubstr("line 2"));
}

TEST(ForeignFiles, LinesOfTrajnet) {
  const world::Trace trace = read(
      R"({"scene": {"id": 0, "p": 1, "s": 0, "e": 20, "fps": 2.5}}
{"track": {"f": 0, "p": 1, "x": 1.0, "y": 2.0}}
{"track": {"f": 10, "p": 1, "x": 1.5, "y": 2.0}}
)",
      "scene.ndjson", {});
  ASSERT_EQ(trace.agents(), 1U);
  EXPECT_EQ(trace.steps(), 2U);
  EXPECT_THAT(refusal("{\"track\": {\"f\": 0, \"p\": 1, \"x\": 1, \"y\": 2}}\n", "s.ndjson"),
              HasSubstr("--frame-rate"));
}

/// Three people abreast who walk along x, the frame first, as ETH/UCY and TrajNet have it.
std::string abreast(double step_m, int frame_step, double apart_m, bool frame_first) {
  std::string text;
  for (int i = 0; i < 12; ++i) {
    for (int person = 1; person <= 3; ++person) {
      const int frame = 780 + frame_step * i;
      text += fmt::format("{}.0\t{}.0\t{:.3f}\t{:.3f}\n", frame_first ? frame : person,
                          frame_first ? person : frame, 8 + step_m * i, apart_m * person);
    }
  }
  return text;
}

TEST(ForeignFiles, FramesInTheFirstColumnAreRecognized) {
  for (const bool frame_first : {true, false}) {
    for (const auto& [step_m, frame_step, apart_m] :
         {std::tuple(0.5, 10, 1.0), std::tuple(0.13, 1, 2.0), std::tuple(0.5, 6, 0.6)}) {
      for (const char* name : {"walk.txt", "walk.csv"}) {
        const world::Trace trace =
            read(abreast(step_m, frame_step, apart_m, frame_first), name, at_rate(25));
        EXPECT_EQ(trace.agents(), 3U) << step_m << " " << frame_first;
        EXPECT_EQ(trace.steps(), 12U);
        EXPECT_NEAR(x_at(trace, 1, 2), 8 + step_m, 1e-5);
      }
    }
  }
}

TEST(ForeignFiles, UnclearColumnsAreRefusedWithBothReadings) {
  const std::string text = abreast(0.5, 1, 0.5, true);
  const std::string why = refusal(text, "walk.txt", at_rate(2));
  EXPECT_THAT(why, HasSubstr("12 people in 3 frames or 12 frames with 3 people"));
  EXPECT_THAT(why, HasSubstr("--columns frame,id,x,y"));
  TrajectoryFormat format = at_rate(2);
  format.columns = columns_in_order("frame,id,x,y");
  EXPECT_EQ(read(text, "walk.txt", format).agents(), 3U);
  format.columns = columns_in_order("id,frame,x,y");
  EXPECT_EQ(read(text, "walk.txt", format).agents(), 12U);
  EXPECT_EQ(read("# frame id x y\n" + text, "walk.txt", at_rate(2)).agents(), 3U)
      << "a comment names the columns";
}

TEST(ForeignFiles, ColumnsAreGivenInOrder) {
  const TrajectoryColumns columns = columns_in_order("time, -,person,x,z,y");
  EXPECT_EQ(columns.time, "1");
  EXPECT_EQ(columns.frame, "");
  EXPECT_EQ(columns.person, "3");
  EXPECT_EQ(columns.y, "6");
  for (const char* wrong : {"", "frame,id,x", "frame,time,id,x,y", "id,id,frame,x,y"}) {
    EXPECT_THROW(columns_in_order(wrong), InputError) << wrong;
  }
}

TEST(ForeignFiles, DecimalCommas) {
  EXPECT_NEAR(read("# framerate: 23,976 fps\n# id frame x/m y/m\n1 0 1 1\n1 1 1.1 1\n", "w.txt")
                  .header.dt_s,
              1 / 23.976, 1e-9);
  for (const char* text : {"id;time;x;y\n1;0,0;1,5;2\n1;0,5;1,75;2,0\n",
                           "id\ttime\tx\ty\n1\t0,0\t1,5\t2\n1\t0,5\t1,75\t2,0\n",
                           "id,time,x,y\n1,\"0,0\",\"1,5\",2\n1,\"0,5\",\"1,75\",2\n"}) {
    const world::Trace trace = read(text, "table.csv");
    EXPECT_NEAR(trace.header.dt_s, 0.5, 1e-9) << text;
    EXPECT_NEAR(x_at(trace, 1, 0), 1.75, 1e-6) << text;
  }
  EXPECT_NEAR(x_at(read("1 0 1,5 2\n1 1 1,75 2\n", "w.txt", at_rate(2)), 1, 0), 1.75, 1e-6);
  EXPECT_THAT(refusal("id;frame;x;y\n1;0;1,5;2\n1;1;1.234;2\n", "t.csv", at_rate(2)),
              HasSubstr("line 3"));
  EXPECT_THAT(refusal("id,frame,x,y\n1,0,1,5,2,5\n", "t.csv", at_rate(2)), HasSubstr("6 fields"));
}

TEST(ForeignFiles, ClockTimesAreCountedFromTheFirst) {
  for (const char* times : {"1700000000.0 1700000000.5", "1700000000000 1700000000500",
                            "1700000000000000000 1700000000500000000"}) {
    const std::string both = times;
    const std::size_t space = both.find(' ');
    const world::Trace trace = read("id,timestamp,x,y\n1," + both.substr(0, space) + ",1,2\n1," +
                                        both.substr(space + 1) + ",1.5,2\n",
                                    "t.csv");
    EXPECT_NEAR(trace.header.dt_s, 0.5, 1e-9) << times;
    EXPECT_EQ(trace.steps(), 2U) << times;
  }
  EXPECT_NEAR(
      read("id,time,x,y\n1,2026-05-01T12:00:00.25Z,1,2\n1,2026-05-01T12:00:00.75Z,1,2\n", "t.csv")
          .header.dt_s,
      0.5, 1e-3);
  EXPECT_NEAR(read("id,time [ms],x,y\n1,0,1,2\n1,500,1.5,2\n", "t.csv").header.dt_s, 0.5, 1e-9);
}

std::string utf16(const std::string& text, bool big_endian, bool with_mark) {
  std::string bytes;
  const auto add = [&](char high, char low) {
    bytes += big_endian ? std::string{high, low} : std::string{low, high};
  };
  if (with_mark) add('\xFE', '\xFF');
  for (const char c : text) add('\0', c);
  return bytes;
}

TEST(ForeignFiles, Utf16IsReadAndBinaryDataIsNamed) {
  const std::string table = "ID\tFrame\tX\tY\r\n1\t0\t1,0\t1,5\r\n1\t1\t1,5\t1,5\r\n";
  for (const bool big_endian : {false, true}) {
    for (const bool with_mark : {false, true}) {
      const world::Trace trace = read(utf16(table, big_endian, with_mark), "t.csv", at_rate(2));
      ASSERT_EQ(trace.steps(), 2U);
      EXPECT_NEAR(x_at(trace, 1, 0), 1.5, 1e-6);
    }
  }
  EXPECT_THAT(refusal("PK\x03\x04 and more", "t.csv"), HasSubstr("Excel"));
  EXPECT_THAT(refusal(std::string("\x01\0\x02\0\0\0\x03", 7), "t.csv"), HasSubstr("binary data"));
  EXPECT_THAT(refusal("id,frame,x,y\n1,0,\x1B[31m,0\n", "t.csv", at_rate(2)),
              Not(HasSubstr("\x1B")));
}

TEST(ForeignFiles, MissingRatesAndUnitsAreAskedForByName) {
  EXPECT_THAT(refusal("id,frame,x,y\n1,0,0,0\n", "t.csv"), HasSubstr("--frame-rate"));
  EXPECT_THAT(refusal("1 0 100 0\n1 1 130 0\n1 2 160 0\n", "t.txt", at_rate(25)),
              HasSubstr("--unit-m"));
  TrajectoryFormat format = at_rate(25);
  format.unit_m = 0.01;
  EXPECT_NEAR(x_at(read("1 0 100 0\n1 1 130 0\n", "t.txt", format), 1, 0), 1.3, 1e-6);
}

TEST(ForeignFiles, ObsmatOfEthHasTheHeightInBetween) {
  const world::Trace trace = read(
      "   7.80e+02   1.0e+00   8.45e+00   0.0   3.58e+00  1.6 0.0 0.1\n"
      "   7.90e+02   1.0e+00   9.12e+00   0.0   3.65e+00  1.6 0.0 0.1\n"
      "   8.00e+02   2.0e+00   9.70e+00   0.0   3.70e+00  1.6 0.0 0.1\n",
      "obsmat.txt", at_rate(25));
  ASSERT_EQ(trace.agents(), 2U);
  EXPECT_NEAR(trace.position[0].y(), 3.58, 1e-5);
}

}  // namespace
}  // namespace throng::metrics
