// A job's run in steps: the same traces as `throng simulate`, with policies and by commands.
#include "live/engine/stepped_job.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/files/hash.h"
#include "jobs/pipeline/checks/resolve.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/run_input.h"
#include "sim/run.h"
#include "tests/world/temporary_folder.h"

namespace throng::engine {
namespace {

using nlohmann::json;
using throng::testing::TemporaryFolder;

json small_job() {
  return json::parse(R"({"scenario": "city_square/nearest_exit", "seed": 3, "crowd": {"agents": 30},
    "drones": [{"id": "d1", "start": [0, -10, 20],
                "guidance": {"policy": "waypoints", "waypoints": [[0, -10, 20], [5, -5, 20]]}}],
    "capture": {"to_s": 4}})");
}

/// The hash of the trace that `throng simulate` writes for a job.
std::string simulated(const std::string& text, const std::filesystem::path& file) {
  const auto scenarios = world::scenarios_folder();
  const jobs::JobSpec job = jobs::resolve_job(nlohmann::json::parse(text), "job", scenarios).spec();
  const world::Scenario scenario = jobs::load_job_scenario(job, scenarios);
  sim::simulate(scenario, jobs::run_spec(job, 0), file);
  return sha256_hex_of_file(file);
}

TEST(SteppedJob, ItsTraceIsThatOfSimulate) {
  const TemporaryFolder folder;
  for (const std::uint64_t seed : {3, 8}) {
    json job = small_job();
    RunChoices choices;
    choices.seed = seed;
    choices.trace_file = folder.path() / "steps.h5";
    SteppedJob steps(job.dump(), "job", choices);
    while (!steps.is_over()) steps.step({});
    steps.finish();
    job["seed"] = seed;
    EXPECT_EQ(sha256_hex_of_file(choices.trace_file),
              simulated(job.dump(), folder.path() / "simulated.h5"));
  }
}

TEST(SteppedJob, ArraysKeepTheirPlaceAndShowTheNewestStep) {
  SteppedJob steps(small_job().dump(), "job", {});
  const Eigen::Vector2f* positions = steps.people().position.data();
  const double* drones = steps.drones().data();
  const std::vector<Eigen::Vector2f> first = steps.people().position;
  EXPECT_EQ(steps.time_s(), 0);
  EXPECT_EQ(steps.drones().row(0).head<3>(), Eigen::RowVector3d(0, -10, 20));
  for (int i = 0; i < 10; ++i) steps.step({});
  EXPECT_EQ(steps.people().position.data(), positions);
  EXPECT_EQ(steps.drones().data(), drones);
  EXPECT_NE(steps.people().position, first);
  EXPECT_NEAR(steps.time_s(), 10 * steps.dt_s(), 1e-9);
  EXPECT_NEAR(steps.people().time_s, steps.time_s(), 1e-9);
  EXPECT_GT(steps.drones()(0, 0), 0);  // it flies to x = 5
}

TEST(SteppedJob, AFlightByCommandsIsRepeatedByItsJob) {
  const TemporaryFolder folder;
  RunChoices choices;
  choices.is_remote = true;
  choices.trace_file = folder.path() / "flown.h5";
  SteppedJob steps(small_job().dump(), "job", choices);
  sim::RemoteCommand command;
  for (int i = 0; i < 40; ++i) {
    command.velocity_mps = {i < 20 ? 3.0 : 0.0, i < 20 ? 0.0 : 1.0, 0.2};
    command.yaw_rate_deg_s = 10;
    command.beacon = i > 10;
    steps.step({command});
  }
  EXPECT_GT(steps.drones()(0, 2), 20.5);  // it climbed
  const std::string repeated = steps.flown_job();
  steps.finish();
  EXPECT_EQ(sha256_hex_of_file(choices.trace_file),
            simulated(repeated, folder.path() / "repeated.h5"));
}

TEST(SteppedJob, WrongJobsAndCommandsAreRefused) {
  json job = small_job();
  job["scenario"] = "city_square/nearest_exti";
  EXPECT_THROW(SteppedJob(job.dump(), "job", {}), InputError);
  EXPECT_THROW(SteppedJob("{", "job", {}), InputError);
  SteppedJob steps(small_job().dump(), "job", {});
  EXPECT_THROW(steps.step({sim::RemoteCommand()}), InputError);
  EXPECT_THROW(steps.image(3), InputError);
  steps.step({});
  steps.finish();
  EXPECT_THROW(steps.step({}), InputError);
}

}  // namespace
}  // namespace throng::engine
