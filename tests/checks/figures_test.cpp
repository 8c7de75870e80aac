// Figures of a run follow from each other: a run worked out by hand has no faults, and each figure
// that is changed is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "checks/run_checks.h"
#include "checks/validate_figures.h"
#include "tests/checks/found_by.h"
#include "tests/formats/hand_made.h"

namespace throng::checks {
namespace {

using nlohmann::json;
using ::testing::IsEmpty;

/// Four people from the alarm at 2 s on, watched for 10 s, and one who turned back. The first had
/// left at 1 s; two escape 3 s and 5 s after their start; the last does not, and counts for 10 - 2
/// = 8 s. Mean: 16 / 3 s. The 25 % rank of three is the first, 50 % the second. Two doors: 3 out
/// and 1 in, and 1 out.
json sound_run() {
  return {
      {"people", 5},
      {"duration_s", 10},
      {"left_before_alarm", 1},
      {"people_counts",
       {{"left_by_exit", {{{"id", "north"}, {"people", 1}}, {{"id", "south"}, {"people", 1}}}},
        {"left_by_no_exit", 1},
        {"inside", 1},
        {"casualties", 0},
        {"vanished_inside", 0},
        {"turned_back", 1},
        {"never_inside", 0}}},
      {"casualties", 0},
      {"not_escaped", 1},
      {"mean_escape_time_censored_s", 16.0 / 3},
      {"escape_time_percentiles",
       {{"t25_s", 3}, {"t50_s", 5}, {"t75_s", nullptr}, {"t100_s", nullptr}}},
      {"escape_curve",
       {{"escaped_share", {0, 0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 0.75, 0.75}}}},
      {"by_person",
       {{"agent", {0, 1, 2, 3, 4}},
        {"arrived_s", {0, 0, 0, 0, 3}},
        {"start_s", {2, 2, 2, 2, 3}},
        {"escaped_s", {1, 5, 7, nullptr, nullptr}},
        {"hurt_s", {nullptr, nullptr, nullptr, nullptr, nullptr}},
        {"outcome", {"left", "left", "left", "inside", "turned_back"}},
        {"exit", {"north", nullptr, "south", nullptr, nullptr}},
        {"walked_m", {nullptr, 4, 8, nullptr}},
        {"speed_ratio", {nullptr, 0.5, 1, nullptr}}}},
      {"lower_bound", {{"mean_s", 4}, {"mean_ratio", 4.0 / 3}, {"t50_s", 2.5}, {"t50_ratio", 2}}},
      {"exits",
       {{{"id", "north"},
         {"crossings", {{"out", 3}, {"in", 1}}},
         {"net_out", 2},
         {"share_of_net_out", 2.0 / 3},
         {"capacity_per_s", 3.9},
         {"width_m", 3},
         {"gaps", {{"list_s", {1.5, 2}}}},
         {"last_crossing_s", 6},
         {"demand_s", 4},
         {"clogging_index_s", 2},
         {"mean_clogging_index", 0.5},
         {"demand_flow_per_s", 0.6},
         {"demand_specific_flow_per_ms", 0.2},
         {"time_in_state", {{"congested_s", 1}, {"clogged_s", 2}}},
         {"congested_s", 3},
         {"clogged_s", 2}},
        {{"id", "south"},
         {"crossings", {{"out", 1}, {"in", 0}}},
         {"net_out", 1},
         {"share_of_net_out", 1.0 / 3},
         {"capacity_per_s", 1.3},
         {"gaps", {{"list_s", json::array()}}},
         {"last_crossing_s", 7}}}},
      // Shares of the capacity are 3/4 and 1/4.
      {"exit_balance", {{"balance", 1 - (3.0 / 4 - 2.0 / 3)}}},
      {"journeys", {{"walked_m", {{"median", 6}}}, {"speed_ratio", {{"median", 0.75}}}}},
      {"remaining", {{"people", 1}, {"walking", 1}, {"blocked", 0}}},
      {"drones", {{{"flown_m", 120}, {"energy_wh", 2}}, {{"flown_m", 30}, {"energy_wh", 1}}}},
      {"guidance", {{"flown_km", 0.15}, {"energy_wh", 3}}},
      {"exposure",
       {{"above_2_per_m2_person_s", 3},
        {"above_4_per_m2_person_s", 1},
        {"level_of_service", {{"A_person_s", 25}, {"B_person_s", 3}}}}}};
}

std::vector<std::string> list_faults(const json& run) {
  std::vector<std::string> faults;
  check_run_figures(run, [&](const std::string& what) { faults.push_back(what); });
  return faults;
}

TEST(RunFigures, ThoseThatFollowFromEachOtherHaveNoFaults) {
  EXPECT_THAT(list_faults(sound_run()), IsEmpty());
  EXPECT_THAT(list_faults(json::object()), IsEmpty()) << "other versions have fewer";
}

TEST(RunFigures, EachOneThatIsChangedIsNamed) {
  const std::vector<std::pair<const char*, json>> changes = {
      {"/people", 6},
      {"/left_before_alarm", 0},
      {"/casualties", 1},
      {"/not_escaped", 2},
      {"/people_counts/left_by_no_exit", 0},
      {"/people_counts/left_by_exit/1/people", 2},
      {"/by_person/outcome/3", "vanished"},
      {"/mean_escape_time_censored_s", 6},
      {"/escape_time_percentiles/t50_s", 4},
      {"/escape_time_percentiles/t75_s", 9},
      {"/escape_time_percentiles/t25_s", nullptr},
      {"/escape_curve/escaped_share/6", 0.75},
      {"/by_person/escaped_s/3", 9},
      {"/lower_bound/mean_ratio", 1.5},
      {"/lower_bound/t50_ratio", 1.9},
      {"/exits/0/net_out", 3},
      {"/exits/0/crossings/out", 4},
      {"/exits/1/share_of_net_out", 0.5},
      {"/exits/0/mean_clogging_index", 0.4},
      {"/exits/0/demand_specific_flow_per_ms", 0.3},
      {"/exits/0/congested_s", 1},
      {"/exit_balance/balance", 0.8},
      {"/journeys/walked_m/median", 5},
      {"/remaining/walking", 0},
      {"/drones/0/flown_m", 140},
      {"/guidance/energy_wh", 4},
      {"/exposure/above_4_per_m2_person_s", 3.5},
      {"/exposure/level_of_service/A_person_s", 80}};
  for (const auto& [pointer, value] : changes) {
    json run = sound_run();
    run[json::json_pointer(pointer)] = value;
    EXPECT_FALSE(list_faults(run).empty()) << pointer;
  }
}

TEST(RunFigures, CrossingsAreBackFromTheLastOneByTheGaps) {
  EXPECT_THAT(crossing_times(sound_run().at("exits").at(0)), ::testing::ElementsAre(2.5, 4, 6));
  EXPECT_THAT(crossing_times({{"last_crossing_s", nullptr}}), IsEmpty());
}

TEST(JobRules, RecordsAreThoseOfTheJob) {
  const json manifest = {
      {"job",
       {{"drones",
         {{{"id", "d1"},
           {"camera",
            {{"width", 100},
             {"height", 80},
             {"model", "pinhole"},
             {"hfov_deg", 90},
             {"sensor", {{"iso", 400}, {"exposure_s", {{"uniform", {0, 0.01}}}}, {"ev", 0}}}}}}}},
        {"environment", {{"weather", "fog"}, {"time_of_day", {{"choice", {"10:00", "11:00"}}}}}}}}};
  const auto faults = [&](const std::function<void(formats::Image&)>& damage) {
    formats::Image image = formats::hand_made::image();
    image.record["sensor"] = {{"iso", 400}, {"exposure_s", 0.005}, {"ev", 0.5}};
    image.record["environment"] = {{"weather", "fog"}, {"time_of_day", "10:00"}};
    image.record["drawn"] = {{"drones.0.camera.sensor.exposure_s", 0.005},
                             {"environment.time_of_day", "10:00"},
                             {"frame.ev", 0.5}};
    damage(image);
    return found_by([&](Findings& findings) { check_job(manifest, image, findings); });
  };
  EXPECT_THAT(faults([](formats::Image&) {}), IsEmpty());
  struct Damage {
    const char* pointer;
    json value;
  };
  for (const Damage& damage : std::vector<Damage>{{"/sensor/iso", 6400},
                                                  {"/sensor/exposure_s", 0.006},
                                                  {"/sensor/ev", 0},
                                                  {"/environment/weather", "rain"},
                                                  {"/environment/time_of_day", "11:00"},
                                                  {"/camera/model", "fisheye"}}) {
    EXPECT_EQ(faults([&](formats::Image& image) {
                image.record[json::json_pointer(damage.pointer)] = damage.value;
              }).size(),
              1U)
        << damage.pointer;
  }
  EXPECT_EQ(faults([](formats::Image& image) { image.camera_matrix(0, 0) = 51.5; }).size(), 1U);
  EXPECT_EQ(faults([](formats::Image& image) { image.width = 101; }).size(),
            2U);  // and the focal length
}

}  // namespace
}  // namespace throng::checks
