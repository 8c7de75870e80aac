// Units of positions and times that names of columns and comments state.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files/files.h"
#include "metrics/trajectories/trajectory_file.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

world::Trace walk(const std::string& text, const TrajectoryFormat& format = {}) {
  const testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "walk.txt", text);
  return read_trajectory(folder.path() / "walk.txt", {}, format);
}

std::string why_not(const std::string& text) {
  try {
    walk(text);
  } catch (const InputError& error) {
    return error.problems().at(0).text();
  }
  return "accepted";
}

std::string below(const std::string& comment) {
  return "# framerate: 10\n" + comment + "\n1 0 10 20\n1 1 10.1 20\n";
}

/// The place (10, 20) in units of these lengths.
void expect_units(const std::string& text, double x_m, double y_m) {
  SCOPED_TRACE(text);
  try {
    const world::Trace trace = walk(text);
    EXPECT_NEAR(trace.position[0].x(), 10 * x_m, 1e-5 * x_m);
    EXPECT_NEAR(trace.position[0].y(), 20 * y_m, 1e-5 * y_m);
  } catch (const InputError& error) {
    ADD_FAILURE() << error.problems().at(0).text();
  }
}

TEST(Units, InCommentsAreUsed) {
  for (const auto& [comment, unit_m] : std::vector<std::pair<std::string, double>>{
           {"# id frame x/ft y/ft", 0.3048},
           {"# id frame x/yd y/yd", 0.9144},
           {"# id frame x/dm y/dm z/m", 0.1},
           {"# id frame x/km y/km", 1000},
           {"# id frame x [ft] y [ft]", 0.3048},
           {"# id frame x (in feet) y (in feet)", 0.3048},
           {"# id\tframe\tx [\u00b5m]\ty [\u00b5m]", 1e-6},
           {"# id frame x_ft y_ft", 0.3048},
           {"# x/ft, y/ft", 0.3048},
           {"# positions (x/cm, y/cm)", 0.01},
           {"# id frame x y [ft]", 0.3048},
           {"# id frame x y z in inches", 0.0254},
           {"# units: feet", 0.3048},
           {"# Units = Feet", 0.3048},
           {"#unit=ft", 0.3048},
           {"# unit ft", 0.3048},
           {"# unit of length: inch", 0.0254},
           {"# length unit [yd]", 0.9144},
           {"# Units: in", 0.0254},
           {"# units are yards", 0.9144},
           {"# unit = 0.01 m", 0.01},
           {"# framerate: 10 fps; unit: cm", 0.01},
           {"# time unit: s. unit of length: ft", 0.3048},
           {"# coordinates in inches", 0.0254},
           {"# coordinates (in)", 0.0254},
           {"# Coordinates are given in US survey feet", 0.3048},
           {"# all lengths are in millimetres", 0.001},
           {"# positions in ft, heights in cm", 0.3048},
           {"# heights in cm, positions in ft", 0.3048},
           {"# in cm: x, y and z", 0.01},
           {"# trajectories, exported in cm", 0.01},
           {"# x: ft, y: ft", 0.3048},
           {"# lengthUnit: ft", 0.3048},
           {"# unit: 'cm'", 0.01},
           {"# Length in cm, time in s", 0.01},
           {"# Einheit: cm", 0.01},
           {"# [ft]", 0.3048},
           {"# feet", 0.3048}}) {
    expect_units(below(comment), unit_m, unit_m);
  }
}

TEST(Units, OfOtherThingsAndOtherWordsAreNone) {
  for (const char* comment : {"# recorded in Rome, people in blue, 25 m corridor",
                              "# corridor length in cm: 400",
                              "# heights in cm",
                              "# z: height in mm",
                              "# max (cm): 400",
                              "# positions of the feet",
                              "# position: foot",
                              "# walking speed in ft/s",
                              "# x, y and speeds in km/h",
                              "# PeTrack project: 040.pet",
                              "# raw trajectory file: in.trc",
                              "# trajectory file: m.trc",
                              "# z: can be 3d position or height of person (alternating or not)",
                              "#X,Y,Z: the agents coordinates (in metres)",
                              "#ANGLE: orientation (in degrees)",
                              "#A, B: semi-axes of the ellipse",
                              "#description: my simulation",
                              "#FR: the current frame",
                              "#geometry: geometry.xml",
                              "#ID\tFR\tX\tY\tZ\tA\tB\tANGLE\tCOLOR",
                              "# x/y plane",
                              "# angle units: degrees",
                              "# angleUnit: degrees",
                              "# video 1920 x 1080 px, coordinates in m",
                              "# unit of angle: rad",
                              "# units of x and y: m",
                              "# unit 3: corridor",
                              "# density in 1/m^2, flow in 1/s",
                              "# area in ft^2",
                              "# id frame x (east) y (north)",
                              "# id frame x/m y/m z/cm",
                              "# person no, x_min, y_min",
                              "# unit of length: m, of time: s",
                              "# people in a yard, one in a mile of"}) {
    expect_units(below(comment), 1, 1);
  }
}

TEST(Units, InNamesOfColumnsAreUsedForEachAxis) {
  const auto named = [](const std::string& x, const std::string& y) {
    return "# framerate: 10\nid,frame," + x + "," + y + "\n1,0,10,20\n1,1,10.1,20\n";
  };
  for (const auto& [x, y, x_m, y_m] :
       std::vector<std::tuple<std::string, std::string, double, double>>{
           {"x_ft", "y_ft", 0.3048, 0.3048},
           {"X [yd]", "Y [yd]", 0.9144, 0.9144},
           {"Pos_X (in)", "Pos_Y (in)", 0.0254, 0.0254},
           {"pos_x_cm", "pos_y_cm", 0.01, 0.01},
           {"xcm", "ycm", 0.01, 0.01},
           {"xFeet", "yFeet", 0.3048, 0.3048},
           {"x_in_feet", "y_in_feet", 0.3048, 0.3048},
           {"x in mm", "y in mm", 0.001, 0.001},
           {"x/cm", "y/m", 0.01, 1},
           {"x", "y [ft]", 0.3048, 0.3048},
           {"x [-]", "y [-]", 1, 1}}) {
    expect_units(named(x, y), x_m, y_m);
  }
  expect_units("# framerate: 10\n# x/m y/cm z/m\n1 0 10 20\n", 1, 0.01);
  expect_units("# framerate: 10\nid frame x [ft] y [cm]\n1 0 10 20\n", 0.3048, 0.01);
  expect_units("# framerate: 10\n# coordinates in cm\nid,frame,x [ft],y [ft]\n1,0,10,20\n", 0.3048,
               0.3048);
  expect_units("t,id,x,y\ns,,in,yd\n0,1,10,20\n0.1,1,10,20\n", 0.0254, 0.9144);
  TrajectoryFormat format;
  format.columns = {"1", "2", "", "3", "4"};
  EXPECT_NEAR(walk(named("east [ft]", "north [ft]"), format).position[0].x(), 3.048, 1e-5);
}

TEST(Units, ThatCannotBeUsedAreRefusedWithTheirLine) {
  EXPECT_THAT(why_not(below("# id frame x/furlong y/furlong")),
              AllOf(HasSubstr("line 2"), HasSubstr("furlong"), HasSubstr("inches")));
  EXPECT_THAT(why_not(below("# units: cubits")), HasSubstr("cubits"));
  for (const char* comment :
       {"# id frame x/px y/px", "# coordinates in pixels", "# unit: px",
        "# x, y: pixel coordinates", "# positions in image pixels",
        "# x, y are in the camera's pixel frame", "# coordinate system: pixel"}) {
    EXPECT_THAT(why_not(below(comment)), AllOf(HasSubstr("line 2"), HasSubstr("length of a pixel")))
        << comment;
  }
  EXPECT_THAT(why_not("# framerate: 10\nid,frame,x_px,y_px\n1,0,1,2\n"), HasSubstr("line 2"));
  EXPECT_THAT(why_not("# framerate: 10\nid,frame,x [s],y [s]\n1,0,1,2\n"), HasSubstr("line 2"));
  TrajectoryFormat format;
  format.unit_m = 0.05;
  EXPECT_NEAR(walk(below("# coordinates in pixels"), format).position[0].x(), 0.5, 1e-6);
  expect_units("# framerate: 10\nid,frame,x_px,y_px,x_m,y_m\n1,0,310,220,10,20\n", 1, 1);
}

TEST(Units, OfTimes) {
  const auto timed = [](const std::string& name, double step) {
    return fmt::format("id,{},x,y\n1,0,10,20\n1,{},10,20\n1,{},10,20\n", name, step, 2 * step);
  };
  for (const auto& [name, step_s] :
       std::vector<std::pair<std::string, double>>{{"time [ms]", 1e-3},
                                                   {"time_ms", 1e-3},
                                                   {"timems", 1e-3},
                                                   {"t (s)", 1},
                                                   {"timestamp_us", 1e-6},
                                                   {"time/min", 60},
                                                   {"time [UTC]", 1},
                                                   {"milliseconds", 1e-3},
                                                   {"time [hh:mm:ss]", 1}}) {
    EXPECT_NEAR(walk(timed(name, 0.5 / step_s)).header.dt_s, 0.5, 1e-6) << name;
  }
  EXPECT_THAT(why_not(timed("time [frames]", 1)), HasSubstr("--frame-rate"));
  EXPECT_NEAR(walk("# framerate: 10\n" + timed("time [frames]", 1)).header.dt_s, 0.1, 1e-9);
  EXPECT_THAT(why_not(timed("time [fortnights]", 1)), HasSubstr("line 1"));
  EXPECT_NEAR(walk("# id time/ms x/cm y/cm\n1 0 10 20\n1 500 10 20\n").header.dt_s, 0.5, 1e-9);
}

}  // namespace
}  // namespace throng::metrics
