// Warnings about recorded people: speeds, and people in buildings.
#include "metrics/trajectories/recorded_findings.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files/files.h"
#include "metrics/trajectories/trajectory_file.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

world::Trace recording(const std::string& text, std::vector<Problem>* notes = nullptr) {
  const testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "walk.txt", text);
  return read_trajectory(folder.path() / "walk.txt", {}, {}, notes);
}

std::string notes_about(const std::string& text) {
  std::vector<Problem> notes;
  recording(text, &notes);
  std::string all;
  for (const Problem& note : notes) all += note.text();
  return all;
}

TEST(RecordedFindings, SpeedsThatNoHumanHas) {
  const std::string head = "# framerate: 10\n# id frame x/m y/m\n";
  EXPECT_EQ(notes_about(head + "1 0 0 0\n1 1 1.1 0\n1 2 2.2 0\n"), "");
  EXPECT_THAT(notes_about(head + "7 100 0 0\n7 102 0.2 0\n7 104 50 0\n7 106 50.2 0\n8 100 0 5\n"
                                 "8 200 9 5\n8 202 12 5\n"),
              AllOf(HasSubstr("2 steps of 2 people faster than 12 m/s"), HasSubstr("249 m/s"),
                    HasSubstr("person 7 from frame 102 to 104")));
  EXPECT_THAT(notes_about("# framerate: 10\nid,frame,x/m,y/m\nanna,0,0,0\nanna,40,80,0\n"),
              HasSubstr("20 m/s: person anna from frame 0 to 40"));
  EXPECT_EQ(notes_about("# framerate: 10\n# id frame x/cm y/cm\n1 0 0 0\n1 1 14 0\n"), "");
}

TEST(RecordedFindings, PeopleInBuildings) {
  world::Scenario scenario;
  scenario.id = "court";
  // An L around a court, and a second one.
  scenario.buildings = {
      {.id = "corner", .footprint = {{0, 0}, {20, 0}, {20, 5}, {5, 5}, {5, 20}, {0, 20}}},
      {.id = "kiosk", .footprint = {{30, 30}, {34, 30}, {34, 34}, {30, 34}}}};
  const std::string head = "# framerate: 10\n# id frame x/m y/m\n";
  const auto findings = [&](const std::string& rows) {
    std::string all;
    for (const Problem& found : find_people_in_buildings(recording(head + rows), scenario)) {
      all += found.text();
    }
    return all;
  };
  EXPECT_EQ(findings("1 0 10 10\n1 1 10.1 10\n2 0 5.0 10\n2 1 4.9 10\n3 0 25 25\n"), "")
      << "in the court, and at a wall within what calibration allows";
  EXPECT_THAT(findings("1 0 10 2\n1 1 10.1 2\n1 2 10.2 2\n2 0 10 10\n2 1 32 32\n3 5 2 18\n"),
              AllOf(HasSubstr("3 of 3 recorded people inside of buildings, in 4 of 6 frames"),
                    HasSubstr("\"corner\" (2), \"kiosk\" (1)"), HasSubstr("court")));
  scenario.buildings.clear();
  EXPECT_EQ(findings("1 0 10 2\n"), "");
}

}  // namespace
}  // namespace throng::metrics
