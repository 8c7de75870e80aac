// Times of the day in words, as jobs say them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "spec/job/environment.h"
#include "spec/job/spec.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json job_at(const json& time, const json& more = json::object()) {
  json job = {{"scenario", "yard"}, {"environment", {{"time_of_day", time}}}};
  job.merge_patch(more);
  return job;
}

json resolved(const json& job) {
  return to_json(parse_job(job.dump(), "job.json"))["environment"]["time_of_day"];
}

Problem find_problem(const json& job) {
  try {
    parse_job(job.dump(), "job.json");
  } catch (const InputError& error) {
    return error.problems().front();
  }
  return {"", "", "accepted", ""};
}

double elevation_deg(const std::string& time, double latitude_deg, int day) {
  const double hours = std::stod(time) + std::stod(time.substr(3)) / 60;
  return sun_at(hours, latitude_deg, day).elevation_rad / kDegree;
}

TEST(SunTimes, AreWhereTheSunIs) {
  for (const double latitude : {-52.0, 0.0, 45.0, 60.0}) {
    for (const int day : {1, 80, 172, 300}) {
      const json where = {{"environment", {{"latitude_deg", latitude}, {"day_of_year", day}}}};
      for (const auto& [word, elevation] :
           {std::pair("dawn", -6), {"sunrise", 0}, {"sunset", 0}, {"dusk", -6}}) {
        const std::string time = resolved(job_at(word, where));
        EXPECT_NEAR(elevation_deg(time, latitude, day), elevation, 0.13) << word << latitude << day;
        EXPECT_EQ(time < "12:00", word == std::string("dawn") || word == std::string("sunrise"));
      }
      EXPECT_EQ(resolved(job_at("noon", where)), "12:00");
      EXPECT_EQ(resolved(job_at("midnight", where)), "00:00");
    }
  }
  EXPECT_EQ(resolved(job_at("sunset")), "19:02") << "as docs/job.md says";
  EXPECT_EQ(resolved(job_at("15:30")), "15:30");
}

TEST(SunTimes, HaveOffsets) {
  for (const char* time : {"sunset-20min", "sunset - 20 min", "sunset\u221220min"}) {
    EXPECT_EQ(resolved(job_at(time)), "18:42") << time;
  }
  EXPECT_EQ(resolved(job_at("noon+2h")), "14:00");
  EXPECT_EQ(resolved(job_at("dusk+1h")), "20:39");
  EXPECT_THAT(find_problem(job_at("noon+12h")).expected, HasSubstr("same day: noon is at 12:00"));
  EXPECT_THAT(find_problem(job_at("midnight-1min")).expected, HasSubstr("same day"));
  EXPECT_THAT(find_problem(job_at("noon+99999999999h")).expected, HasSubstr("HH:MM"));
}

TEST(SunTimes, MayBeRanges) {
  EXPECT_EQ(resolved(job_at({{"uniform", {"14:00", "sunset"}}})),
            json({{"uniform", {"14:00", "19:02"}}}));
  EXPECT_EQ(resolved(job_at({{"choice", {"noon", "dusk-5min"}}})),
            json({{"choice", {"12:00", "19:34"}}}));
  EXPECT_EQ(find_problem(job_at({{"uniform", {"dusk", "noon"}}})).where,
            "/environment/time_of_day/uniform/1");
  const json job = {{"scenario", "yard"},
                    {"randomize", {{"environment.time_of_day", {{"uniform", {"noon", "dusk"}}}}}}};
  const JobSpec spec = parse_job(job.dump(), "job.json");
  EXPECT_EQ(to_json(spec)["environment"]["time_of_day"]["uniform"][1], "19:39");
  json wrong = job;
  wrong["randomize"]["environment.time_of_day"]["uniform"][1] = "dusky";
  EXPECT_EQ(find_problem(wrong).where, "/randomize/environment.time_of_day/uniform/1");
}

TEST(SunTimes, WordsThatAreNoneNameTheNearest) {
  for (const auto& [time, near] : {std::pair("dusc", "dusk"),
                                   {"Dusk", "dusk"},
                                   {"sunste", "sunset"},
                                   {"sunset-20", "sunset"},
                                   {"sunrize+5min", "sunrise"}}) {
    const Problem problem = find_problem(job_at(time));
    EXPECT_EQ(problem.where, "/environment/time_of_day");
    EXPECT_EQ(problem.source, "job.json");
    EXPECT_THAT(problem.expected, HasSubstr(near)) << time;
  }
  EXPECT_THAT(find_problem(job_at("dusc")).expected, HasSubstr("did you mean dusk?"));
  EXPECT_THAT(find_problem(job_at("25:00")).expected, HasSubstr("HH:MM"));
  EXPECT_THAT(find_problem(job_at("")).expected, HasSubstr("HH:MM"));
  EXPECT_THAT(find_problem(job_at(7)).expected, HasSubstr("HH:MM"));
}

TEST(SunTimes, NeedASunThatGetsThere) {
  const json summer = {{"environment", {{"latitude_deg", 80}, {"day_of_year", 172}}}};
  const json winter = {{"environment", {{"latitude_deg", 80}, {"day_of_year", 355}}}};
  EXPECT_THAT(find_problem(job_at("sunset", summer)).expected,
              HasSubstr("at latitude 80 on day 172 there is no sunset, the sun stays above the"));
  EXPECT_THAT(find_problem(job_at("dawn", winter)).expected,
              HasSubstr("the sun stays below 6 degrees below the horizon all day"));
  EXPECT_EQ(resolved(job_at("noon", winter)), "12:00");
  const json sampled = {{"environment", {{"latitude_deg", {{"uniform", {10, 20}}}}}}};
  EXPECT_THAT(find_problem(job_at("sunset", sampled)).expected, HasSubstr("latitude"));
  EXPECT_EQ(resolved(job_at("noon", sampled)), "12:00");
}

}  // namespace
}  // namespace throng::jobs
