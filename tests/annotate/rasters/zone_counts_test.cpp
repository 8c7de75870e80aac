// Counts in zones and across lines, of a trace made by hand.
#include "annotate/rasters/zone_counts.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/annotate/synthetic_frame.h"

namespace throng::annotate {
namespace {

using nlohmann::json;

/// Steps of half a second. Agent 0 walks along y = 0 from x = -1.5 eastward, a meter a step; agent
/// 1 is a hazard; agent 2 goes to and fro across x = 0; agent 3 leaves after the second step.
world::Trace three_people() {
  world::Trace trace;
  trace.header.role = {world::AgentRole::person, world::AgentRole::disaster,
                       world::AgentRole::person, world::AgentRole::person};
  trace.time_s = {0, 0.5, 1, 1.5, 2};
  const std::vector<float> to_and_fro = {-0.5F, 0.5F, -0.5F, 0.5F, 0.5F};
  for (std::size_t step = 0; step < 5; ++step) {
    trace.position.emplace_back(-1.5F + static_cast<float>(step), 0);
    trace.position.emplace_back(0, 0);
    trace.position.emplace_back(to_and_fro[step], 1);
    trace.position.emplace_back(2, 2);
    for (const bool is_there : {true, true, true, step < 2}) {
      trace.flags.push_back(is_there ? world::kPresent : 0);
      trace.yaw_rad.push_back(0);
    }
  }
  return trace;
}

/// Cells after the time, of the row of a frame and an area.
std::string find_row(const std::string& csv, int frame, const std::string& id) {
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(std::to_string(frame) + ",")) continue;
    const auto at = line.find("," + id + ",");
    if (at != std::string::npos) return line.substr(at + id.size() + 2);
  }
  return "none";
}

const CountAreas kAreas = {.zones = {{"east", {{0, -5}, {5, -5}, {5, 5}, {0, 5}}}},
                           .lines = {{"axis", {0, -5}, {0, 5}}, {"short", {0, 0.5}, {0, 5}}}};

TEST(ZoneCounts, ListPeopleInsideAndChanges) {
  const std::string csv = counts_csv(three_people(), kAreas, std::vector<double>{0, 1, 2}, 3);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "frame,time_s,kind,id,inside,inflow,outflow,entered,left");
  EXPECT_EQ(find_row(csv, 0, "east"), "1,1,0,3000004,");
  EXPECT_EQ(find_row(csv, 1, "east"), "1,1,1,3000001,3000004");
  EXPECT_EQ(find_row(csv, 2, "east"), "2,1,0,3000003,");
}

TEST(ZoneCounts, OfLinesAreEachCrossing) {
  const std::string csv = counts_csv(three_people(), kAreas, std::vector<double>{0, 1, 2}, 3);
  // West of the way north is inward. To and fro within a frame are two crossings.
  EXPECT_EQ(find_row(csv, 0, "axis"), ",0,0,,");
  EXPECT_EQ(find_row(csv, 1, "axis"), ",1,2,3000003,3000003 3000001");
  EXPECT_EQ(find_row(csv, 2, "axis"), ",0,1,,3000003");
  EXPECT_EQ(find_row(csv, 1, "short"), ",1,1,3000003,3000003") << "agent 0 goes beside it";
}

TEST(ZoneCounts, OfLinesAreInTheFrameAfterTheMoment) {
  const std::vector<double> times_s = {0.2, 0.3, 0.8, 5};
  const std::string csv = counts_csv(three_people(), kAreas, times_s, 0);
  EXPECT_EQ(find_row(csv, 1, "axis"), ",0,1,,3") << "at 0.25 s";
  EXPECT_EQ(find_row(csv, 2, "axis"), ",1,1,3,1") << "both at 0.75 s";
  EXPECT_EQ(find_row(csv, 3, "axis"), ",0,1,,3");
}

TEST(ZoneCounts, ComeWithTheGroundAndDoors) {
  world::Scenario scenario;
  scenario.ground = {{-5, -5}, {5, 5}};
  scenario.exits.resize(2);
  for (world::Exit& exit : scenario.exits) {
    exit.id = &exit == scenario.exits.data() ? "a" : "b";
    exit.from = {4, -1};
    exit.to = {4, 1};
    exit.outward = {1, 0};
  }
  std::swap(scenario.exits[1].from, scenario.exits[1].to);
  const CountAreas areas = count_areas(scenario, kAreas);
  ASSERT_EQ(areas.zones.size(), 2U);
  EXPECT_EQ(areas.zones[0].id, "ground");
  ASSERT_EQ(areas.lines.size(), 4U);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(areas.lines[i].from, Eigen::Vector2d(4, -1)) << "the place is to the left";
    EXPECT_EQ(areas.lines[i].to, Eigen::Vector2d(4, 1));
  }
  const json record = json::parse(counts_json(areas));
  EXPECT_EQ(record.at("zones")[0].at("corners"),
            json::parse("[[-5.0,-5.0],[5.0,-5.0],[5.0,5.0],[-5.0,5.0]]"));
  EXPECT_EQ(record.at("lines")[2],
            json::parse(R"({"id":"axis","start":[0.0,-5.0],"end":[0.0,5.0]})"));
}

TEST(ZoneCounts, OfImagesAreVisiblePeople) {
  render::Frame frame = synthetic_frame({});
  FrameLabels labels = label_people(frame);
  ASSERT_GT(labels.people.size(), 3U);
  for (PersonLabel& label : labels.people) label.person.position = {-1, 0, 0};
  labels.people[0].person.position = {1, 1, 0};
  labels.people[1].person.position = {5, 5, 0};  // on a corner
  EXPECT_EQ(json::parse(visible_in_zones(labels, kAreas.zones)),
            json::parse(R"([{"id":"east","visible":2}])"));
}

}  // namespace
}  // namespace throng::annotate
