#include "formats/dataset/run_events.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

namespace throng::formats {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

RunEvent event(double time_s, const std::string& type, const json& more) {
  return {time_s, type, more};
}

template <typename Check>
std::vector<std::string> list_faults(const Check& check) {
  std::vector<std::string> faults;
  check([&](std::size_t /*event*/, const std::string& what) { faults.push_back(what); });
  return faults;
}

std::vector<std::string> faults_of_records(const std::vector<RunEvent>& events) {
  return list_faults([&](const EventReport& report) { check_event_records(events, report); });
}

std::vector<std::string> faults_of_figures(const std::vector<RunEvent>& events,
                                           const json& figures) {
  return list_faults(
      [&](const EventReport& report) { check_events_against_figures(events, figures, 1, report); });
}

const json kFigures = {
    {"by_person",
     {{"agent", {0, 1}},
      {"arrived_s", {0, 4}},
      {"noticed_s", {5.5, nullptr}},
      {"escaped_s", {9, nullptr}}}},
    {"falls", {{"struck", 1}, {"crushed", 0}}},
    {"drones",
     {{{"id", "d1"}, {"near_misses", 1}, {"landed_s", 7}, {"collisions", {{"person", 1}}}}}}};

std::vector<RunEvent> sound_events() {
  return {event(2, "escapes", {{"track_id", 2}}),  // arrives from outside
          event(5.5, "notices", {{"track_id", 1}}),
          event(6, "collision", {{"drone", "d1"}, {"partner", "person"}, {"track_id", 1}}),
          event(6, "falls", {{"track_id", 1}, {"cause", "drone"}}),
          event(6.5, "near_miss", {{"drone", "d1"}, {"partner", "ground"}}),
          event(7, "landed", {{"drone", "d1"}}),
          event(9, "escapes", {{"track_id", 1}})};
}

TEST(RunEvents, AreThoseOfTheFigures) {
  EXPECT_THAT(faults_of_figures(sound_events(), kFigures), IsEmpty());
}

TEST(RunEvents, WithoutOneTheFiguresHaveTooMany) {
  const std::vector<RunEvent> sound = sound_events();
  for (std::size_t i = 1; i < sound.size(); ++i) {
    std::vector<RunEvent> events = sound;
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_EQ(faults_of_figures(events, kFigures).size(), 1U) << sound[i].type;
  }
}

TEST(RunEvents, AtOtherTimesAreFound) {
  for (const std::size_t i : {1U, 5U, 6U}) {
    std::vector<RunEvent> events = sound_events();
    events[i].time_s -= 0.5;
    EXPECT_THAT(faults_of_figures(events, kFigures), ::testing::Not(IsEmpty())) << events[i].type;
  }
}

TEST(RunEvents, OfNoTypeOrWithoutTheirValuesAreFound) {
  EXPECT_THAT(faults_of_records({event(1, "sneezes", {{"track_id", 1}})}),
              ElementsAre(HasSubstr("sneezes")));
  EXPECT_THAT(faults_of_records({event(1, "notices", json::object())}),
              ElementsAre(HasSubstr("track_id")));
}

TEST(RunEvents, BeginBeforeTheyEnd) {
  const json who = {{"track_id", 1}};
  EXPECT_THAT(faults_of_records({event(1, "departs", who), event(2, "arrives", who),
                                 event(3, "lies_down", who), event(4, "gets_up", who)}),
              IsEmpty());
  EXPECT_EQ(faults_of_records({event(1, "departs", who), event(2, "departs", who)}).size(), 1U);
  EXPECT_EQ(faults_of_records({event(1, "gets_up", who)}).size(), 1U);
}

TEST(RunEvents, TrajectoriesShowPresentPeople) {
  const float absent = std::nanf("");
  const RunTrajectories there{
      {0, 1, 2}, {1, 2}, {"Walk"}, {absent, absent, absent, absent, 1, 1, 0, 0,  //
                                    2,      1,      0,      0,      1, 2, 0, 0,  //
                                    3,      1,      0,      0,      1, 3, 0, 0}};
  const auto faults = [&](const std::vector<RunEvent>& events) {
    return list_faults([&](const EventReport& report) {
      check_events_against_trajectories(events, there, report);
    });
  };
  const json who = {{"track_id", 1}};
  EXPECT_THAT(faults({event(0.5, "arrives", who)}), IsEmpty());
  EXPECT_EQ(faults({event(1.5, "arrives", who)}).size(), 1U);
  EXPECT_EQ(faults({}).size(), 1U);
}

}  // namespace
}  // namespace throng::formats
