// Guidance in jobs: every field survives the round trip, and pilot logs lie beside the job.
#include "spec/job/guidance_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "spec/job/schema.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

DroneSpec read_given(const json& guidance, const std::string& source,
                     std::vector<Problem>& problems) {
  const json job = {{"scenario", "x"}, {"drones", {{{"id", "d"}, {"guidance", guidance}}}}};
  EXPECT_TRUE(schema_problems(job, "job.json").empty());
  DroneSpec drone;
  read_guidance(guidance, source, "/drones/0/guidance", drone, problems);
  return drone;
}

TEST(GuidanceSpec, EveryFieldSurvivesTheRoundTrip) {
  const json given = json::parse(R"({
    "policy": "balance", "speed_mps": 2.5, "waypoints": [[1, 2, 3]], "lead_speed_mps": 1.5,
    "batch": 20, "exits": ["a", "b"], "center": [4, 5], "radius_m": 6, "overlap": 0.5,
    "area": {"min": [-1, -2], "max": [3, 4]},
    "perception": {"kind": "camera", "fov_deg": 60, "delay_s": 0.5, "count_noise": 0.25},
    "setpoints": [[0, 1, 2, 3, 90, 1], [0.5, 1, 2, 3, -45, 0], [1, 1, 2, 3, 0, 0, -60, 12.345]]})");
  std::vector<Problem> problems;
  const DroneSpec drone = read_given(given, "", problems);
  const sim::DroneMission& mission = drone.mission;
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(mission.guidance.perception->kind, sim::PerceptionKind::camera);
  EXPECT_FALSE(mission.guidance.setpoints[1].beacon);
  EXPECT_FALSE(mission.guidance.setpoints[1].gimbal);
  EXPECT_EQ(mission.guidance.setpoints[2].gimbal, (camera::GimbalAngles{-60, 12.345}));
  const json written = guidance_json(drone);
  EXPECT_EQ(written["setpoints"], given["setpoints"]);
  for (const auto& [key, value] : given.items()) {
    EXPECT_TRUE(written.contains(key)) << key;
  }
  EXPECT_EQ(guidance_json(read_given(written, "", problems)), written);
  EXPECT_EQ(written["exits"], given["exits"]);
  EXPECT_EQ(written["batch"], 20);
}

TEST(GuidanceSpec, ASetPointHasBothAnglesOfTheGimbalOrNone) {
  std::vector<Problem> problems;
  read_given(json::parse(R"({"policy": "pilot_log", "setpoints": [
      [0, 1, 2, 3, 90, 1, -45], [1, 1, 2, 3, 90, 1, 31, 0], [2, 1, 2, 3, 90, 1, 0, -181]]})"),
             "", problems);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0].text(),
            "/drones/0/guidance/setpoints/0: found 7 numbers, expected 6, or 8 with the gimbal's "
            "pitch and yaw");
  EXPECT_EQ(problems[1].text(),
            "/drones/0/guidance/setpoints/1/6: found 31 degrees, expected -90 to 30 degrees");
  EXPECT_EQ(problems[2].text(),
            "/drones/0/guidance/setpoints/2/7: found -181 degrees, expected -180 to 180 degrees");
}

TEST(GuidanceSpec, TheOldNameOfTheCenterIsReadWithAWarning) {
  std::vector<Problem> problems;
  testing::internal::CaptureStderr();
  const DroneSpec drone =
      read_given({{"policy", "orbit"}, {"centre", {4, 5}}}, "old.json", problems);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("old.json: /drones/0/guidance/centre is deprecated, use \"center\""));
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(drone.mission.guidance.center, Eigen::Vector2d(4, 5));
  EXPECT_EQ(guidance_json(drone)["center"], json::parse("[4.0, 5.0]"));
  EXPECT_FALSE(guidance_json(drone).contains("centre"));
  read_given({{"centre", {4, 5}}, {"center", {6, 7}}}, "both.json", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/drones/0/guidance/centre");
}

TEST(GuidanceSpec, APilotLogIsNamedFromTheJobsFolderAndNotOpened) {
  const json given = {{"policy", "pilot_log"}, {"log", "nowhere.csv"}};
  std::vector<Problem> problems;
  DroneSpec drone;
  read_guidance(given, "/jobs/one/job.json", "/drones/0/guidance", drone, problems);
  EXPECT_EQ(drone.pilot_log, "/jobs/one/nowhere.csv");
  EXPECT_TRUE(problems.empty());
  DroneSpec of_request;
  read_guidance(given, "", "/drones/0/guidance", of_request, problems);
  EXPECT_EQ(of_request.pilot_log, "");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/drones/0/guidance/log");
  EXPECT_THAT(problems[0].expected, HasSubstr("set-points"));
}

}  // namespace
}  // namespace throng::jobs
