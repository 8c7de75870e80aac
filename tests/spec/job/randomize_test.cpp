// The block "randomize": every field that the schema says may be sampled is sampled, used and
// recorded.
#include "spec/job/randomize.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "spec/job/plan.h"
#include "spec/job/spec.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;

class Randomize : public testing::Test {
 protected:
  static JobSpec parse(const json& job) { return parse_job(job.dump(), "test.job.json"); }

  /// A job of so many runs in which this is sampled.
  static JobSpec drawing(const json& block, int runs = 1) {
    return parse({{"scenario", "yard"},
                  {"runs", runs},
                  {"drones", {{{"id", "d1"}, {"start", {0, 0, 20}}}}},
                  {"randomize", block}});
  }

  static std::vector<std::string> pointers_of(const json& block) {
    std::vector<std::string> pointers;
    try {
      drawing(block, 8);
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems()) pointers.push_back(problem.where);
    }
    return pointers;
  }
};

/// Two values that a field may have.
json two_values(const std::string& path) {
  const std::map<std::string, json> special = {{"crowd.agents", {1, 2}},
                                               {"environment.time_of_day", {"09:00", "17:30"}},
                                               {"environment.weather", {"clear", "rain"}},
                                               {"environment.wind.profile", {"log", "power"}},
                                               {"environment.wind.gusts", {"none", "ou"}},
                                               {"environment.rain_mm_per_h", {2, 9}},
                                               {"environment.day_of_year", {20, 200}},
                                               {"drones.0.camera.hfov_deg", {50, 60}},
                                               {"drones.0.start.2", {12, 15}},
                                               {"crowd.separation", {"soft", "hard"}},
                                               {"crowd.constants", {"best", "posterior"}},
                                               {"quality", {"draft", "high"}}};
  const auto found = special.find(path);
  if (found != special.end()) return found->second;
  if (path.find("processing") != std::string::npos) return {0.4, 0.5};
  if (path.ends_with("_px") && path.starts_with("drones")) return {900, 901};
  if (path.find("distortion") != std::string::npos) return {0.001, 0.002};
  if (path.ends_with("natural_rad_s")) return {10, 12};
  if (path.ends_with("sensor.white_balance_k")) return {5000, 6000};
  if (path.ends_with("full_well_e")) return {5000, 6000};
  if (path.ends_with("visibility_m")) return {500, 900};
  if (path.ends_with("image.quality")) return {70, 90};
  if (path.find(".aim.") != std::string::npos) return {8, 40};
  if (path.ends_with("sigma_px")) return {2, 3};
  return {0.4, 0.5};
}

TEST_F(Randomize, DrawsAndRecordsEveryFieldThatTheSchemaMarks) {
  const std::vector<std::string> paths = random_paths();
  EXPECT_THAT(paths, Contains("drones.0.camera.pitch_deg"));
  EXPECT_THAT(paths, Contains("crowd.agents"));
  EXPECT_GT(paths.size(), 35U);
  for (const std::string& path : paths) {
    const json values = two_values(path);
    json job = {{"scenario", "yard"}, {"runs", 16}};
    job["drones"] = {{{"id", "d1"}, {"start", {0, 0, 20}}}};
    if (path.find(".aim.") != std::string::npos) {
      job["drones"][0].erase("start");
      job["drones"][0]["aim"] = json::object();
    }
    if (path.find("distortion") != std::string::npos) {
      job["drones"][0]["camera"]["model"] = "brown_conrady";
    }
    if (path.ends_with("fy_px")) job["drones"][0]["camera"]["fx_px"] = 900;
    if (path.ends_with("rain_mm_per_h")) job["environment"]["weather"] = "rain";
    if (path.ends_with("wind.roughness_m")) job["environment"]["wind"]["profile"] = "log";
    if (path.ends_with("wind.exponent")) job["environment"]["wind"]["profile"] = "power";
    if (path.ends_with("wind.intensity")) job["environment"]["wind"]["gusts"] = "dryden";
    if (path.find("wind.gust_") != std::string::npos) job["environment"]["wind"]["gusts"] = "ou";
    job["randomize"][path] = {{"choice", values}};
    const JobSpec spec = parse(job);
    std::set<json> drawn;
    std::set<std::string> jobs;
    for (int run = 0; run < spec.runs; ++run) {
      const json record = samples_of_run(spec, run);
      ASSERT_EQ(record.size(), 1U) << path;
      ASSERT_TRUE(record.contains(path)) << record.dump();
      drawn.insert(record[path]);
      const JobSpec run_job = job_of_run(spec, run);
      const std::uint64_t seed = plan_runs(spec).at(static_cast<std::size_t>(run)).seed;
      json had = to_json(run_job);
      had["environment"] = to_json(environment_of_run(run_job.environment, seed));
      had["drones"][0]["camera"] =
          to_json(camera_of_run(run_job.drones[0].camera, seed, camera_pointer(0)));
      std::string pointer = "/" + path;
      std::replace(pointer.begin(), pointer.end(), '.', '/');
      EXPECT_EQ(had.at(json::json_pointer(pointer)), record[path]) << path;
    }
    EXPECT_EQ(drawn, std::set<json>(values.begin(), values.end())) << path;
    EXPECT_EQ(to_json(parse(to_json(spec))), to_json(spec)) << path;
  }
}

TEST_F(Randomize, FieldsWithDistributionsOfTheirOwnMoveToTheirPath) {
  const json distribution = {{"uniform", {-80, -35}}};
  const JobSpec block = drawing({{"drones.0.camera.pitch_deg", distribution}});
  EXPECT_TRUE(block.randomize.empty());
  EXPECT_EQ(to_json(block)["drones"][0]["camera"]["pitch_deg"], distribution);
}

TEST_F(Randomize, MistakesAreNamedInTheBlock) {
  EXPECT_THAT(pointers_of({{"capture.rate_hz", {{"uniform", {1, 2}}}}}),
              ElementsAre("/randomize/capture.rate_hz"));
  EXPECT_THAT(pointers_of({{"crowd.agent", {{"uniform", {1, 2}}}}}),
              ElementsAre("/randomize/crowd.agent"));
  EXPECT_THAT(pointers_of({{"drones.1.camera.pitch_deg", {{"uniform", {-60, -40}}}}}),
              ElementsAre("/randomize/drones.1.camera.pitch_deg"));
  EXPECT_THAT(pointers_of({{"outputs.image.quality", {{"uniform", {50, 101}}}}}),
              ElementsAre("/randomize/outputs.image.quality/uniform/1"));
  EXPECT_THAT(pointers_of({{"drones.0.aim.height_m", {{"uniform", {8, 40}}}}}),
              ElementsAre("/randomize/drones.0.aim.height_m"))
      << "that drone has a start";
}

TEST(DistributionKinds, NormalStaysInRangeAndHasItsMean) {
  std::vector<Problem> problems;
  const Quantity quantity = number_quantity(-90, 30);
  const auto drawn = Distribution::read({{"normal", {-45, 10}}}, quantity, "/x", problems);
  const auto cut = Distribution::read({{"normal", {25, 10}}}, quantity, "/x", problems);
  ASSERT_TRUE(problems.empty());
  constexpr int kDraws = 4000;
  double sum = 0;
  double squares = 0;
  for (std::uint64_t seed = 0; seed < kDraws; ++seed) {
    const double value = drawn.draw(seed, "/x");
    sum += value;
    squares += (value + 45) * (value + 45);
    EXPECT_LE(cut.draw(seed, "/x"), 30);
  }
  EXPECT_NEAR(sum / kDraws, -45, 0.5);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 10, 0.4);
  EXPECT_EQ(drawn.to_json(quantity), (json{{"normal", {-45.0, 10.0}}}));
}

TEST(DistributionKinds, LogUniformHasEquallyManyInEveryOctave) {
  std::vector<Problem> problems;
  const Quantity quantity = number_quantity(0, 409600);
  const auto iso = Distribution::read({{"log_uniform", {100, 1600}}}, quantity, "/x", problems);
  ASSERT_TRUE(problems.empty());
  std::array<int, 4> octaves{};
  constexpr int kDraws = 4000;
  for (std::uint64_t seed = 0; seed < kDraws; ++seed) {
    const double value = iso.draw(seed, "/x");
    ASSERT_GE(value, 100);
    ASSERT_LT(value, 1600);
    ++octaves.at(static_cast<std::size_t>(std::log2(value / 100)));
  }
  for (const int count : octaves) EXPECT_NEAR(count, kDraws / 4, 120);
}

TEST(DistributionKinds, MistakesAreNamed) {
  const auto where = [](const json& value) {
    std::vector<Problem> problems;
    Distribution::read(value, number_quantity(0, 10), "/x", problems);
    return problems.empty() ? std::string() : problems.front().where;
  };
  EXPECT_EQ(where({{"normal", {5, 0}}}), "/x/normal/1");
  EXPECT_EQ(where({{"normal", {11, 1}}}), "/x/normal/0");
  EXPECT_EQ(where({{"log_uniform", {0, 5}}}), "/x/log_uniform/0");
  EXPECT_EQ(where({{"uniform", {6, 5}}}), "/x/uniform/1");
  EXPECT_EQ(where({{"gaussian", {6, 5}}}), "/x");
  EXPECT_EQ(where(11), "/x");
}

}  // namespace
}  // namespace throng::jobs
