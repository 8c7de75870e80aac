// The sun's place and what runs draw from a job's distributions.
#include "spec/job/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/geometry/angle.h"

namespace throng::jobs {
namespace {

using nlohmann::json;

EnvironmentSpec parsed(const char* text) {
  std::vector<Problem> problems;
  EnvironmentSpec spec = read_environment(json::parse(text), problems);
  EXPECT_TRUE(problems.empty());
  return spec;
}

TEST(Sun, RisesInTheEastAndStandsHighestInTheSouthAtNoon) {
  const Sun morning = sun_at(7, 45, 225);
  const Sun noon = sun_at(12, 45, 225);
  const Sun evening = sun_at(17, 45, 225);
  EXPECT_GT(std::cos(morning.azimuth_rad), 0.8);
  EXPECT_LT(std::cos(evening.azimuth_rad), -0.8);
  EXPECT_NEAR(std::sin(noon.azimuth_rad), -1, 1e-9);
  EXPECT_NEAR(morning.elevation_rad, evening.elevation_rad, 1e-9);
}

TEST(Sun, StandsAsHighAsTheAlmanacSays) {
  // Declinations of the solstices and equinoxes: 23.44, -23.44 and about 0 degrees.
  const auto noon_deg = [](double latitude_deg, int day) {
    return sun_at(12, latitude_deg, day).elevation_rad / kDegree;
  };
  EXPECT_NEAR(noon_deg(50, 172), 90 - 50 + 23.44, 0.1);
  EXPECT_NEAR(noon_deg(50, 355), 90 - 50 - 23.44, 0.1);
  EXPECT_NEAR(noon_deg(0, 80), 90, 0.6);
  EXPECT_NEAR(noon_deg(-35, 355), 90 - 35 + 23.44, 0.1);
  EXPECT_LT(sun_at(0, 45, 225).elevation_rad, -25 * kDegree);
  EXPECT_GT(sun_at(0, 70, 172).elevation_rad, 0) << "midnight sun";
}

TEST(EnvironmentOfRun, FixedValuesAreThemselves) {
  const auto spec = parsed(
      R"({"time_of_day": "21:45", "weather": "rain", "rain_mm_per_h": 9, "visibility_m": 700})");
  const RunEnvironment run = environment_of_run(spec, 5);
  EXPECT_DOUBLE_EQ(run.time_of_day_h, 21.75);
  EXPECT_LT(run.light.sun_elevation_rad, 0);
  EXPECT_EQ(run.light.weather, render::Weather::rain);
  EXPECT_EQ(run.light.rain_mm_per_h, 9);
  EXPECT_EQ(run.light.visibility_m, 700);
  EXPECT_EQ(environment_of_run(parsed(R"({"weather": "fog"})"), 5).light.visibility_m, 800);
  EXPECT_EQ(environment_of_run(parsed(R"({"weather": "fog"})"), 5).light.rain_mm_per_h, 0);
}

TEST(EnvironmentOfRun, DistributionsAreDrawnPerRunAndStayInside) {
  const char* text =
      R"({"time_of_day": {"uniform": ["06:30", "20:15"]}, "latitude_deg": {"uniform": [-10, 55]},
          "weather": {"choice": ["clear", "fog"]}, "day_of_year": {"choice": [20, 200]}})";
  const EnvironmentSpec spec = parsed(text);
  EXPECT_EQ(to_json(spec)["time_of_day"], json::parse(text)["time_of_day"]);
  std::set<std::string> weathers;
  std::set<int> days;
  std::set<double> latitudes;
  double earliest = 24;
  double latest = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const json record = to_json(environment_of_run(spec, seed));
    EXPECT_EQ(record, to_json(environment_of_run(spec, seed)));
    const RunEnvironment run = environment_of_run(spec, seed);
    earliest = std::min(earliest, run.time_of_day_h);
    latest = std::max(latest, run.time_of_day_h);
    latitudes.insert(run.latitude_deg);
    weathers.insert(record["weather"]);
    days.insert(run.day_of_year);
  }
  EXPECT_GE(earliest, 6.5);
  EXPECT_LE(latest, 20.25);
  EXPECT_LT(earliest, 7.5) << "spread over the whole range";
  EXPECT_GT(latest, 19.25);
  EXPECT_GE(*latitudes.begin(), -10);
  EXPECT_LE(*latitudes.rbegin(), 55);
  EXPECT_EQ(latitudes.size(), 200U);
  EXPECT_EQ(weathers, (std::set<std::string>{"clear", "fog"}));
  EXPECT_EQ(days, (std::set<int>{20, 200}));
}

TEST(EnvironmentOfRun, FieldsAreDrawnIndependently) {
  const EnvironmentSpec both =
      parsed(R"({"latitude_deg": {"uniform": [0, 50]}, "visibility_m": {"uniform": [100, 200]}})");
  const EnvironmentSpec one = parsed(R"({"latitude_deg": {"uniform": [0, 50]}})");
  const RunEnvironment run = environment_of_run(both, 3);
  EXPECT_EQ(run.latitude_deg, environment_of_run(one, 3).latitude_deg);
  EXPECT_NE(run.latitude_deg / 50, (run.light.visibility_m - 100) / 100);
}

}  // namespace
}  // namespace throng::jobs
