// A scenario of a job whose people are loaded once for all checks.
#include "jobs/pipeline/checks/checked_scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "base/files/resources.h"
#include "jobs/pipeline/runs/run_input.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "sim/planning/aimed_start.h"
#include "sim/run.h"
#include "spec/job/plan.h"
#include "spec/job/spec.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using ::testing::ElementsAreArray;

JobSpec job_that_aims() {
  return check_and_read_job(json::parse(R"({"scenario": "city_square/everyday", "runs": 3,
      "drones": [{"id": "a", "aim": {"height_m": 15}}], "capture": {"to_s": 2}})"),
                            "");
}

CheckedScenario checked_square() {
  return {job_that_aims(),
          scenarios::find_scenario(source_folder() / "scenarios", "city_square/everyday"),
          {1, 2}};
}

TEST(CheckedScenario, ThePeopleAreThoseOfItsFirstRunAndLoadedOnce) {
  CheckedScenario checked = checked_square();
  const crowd::Simulation& people = checked.people();
  EXPECT_EQ(&checked.people(), &people);
  const crowd::Simulation alone =
      sim::load_people(checked.scenario(), run_seed(checked.job(), 1), checked.job().crowd);
  EXPECT_THAT(people.positions(), ElementsAreArray(alone.positions()));
}

TEST(CheckedScenario, DronesAimAtThoseAtWhomTheRunAims) {
  CheckedScenario checked = checked_square();
  const auto expected = sim::people_to_aim_at(checked.scenario(), run_spec(checked.job(), 1));
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(checked.people_to_aim_at(), expected);
}

TEST(CheckedScenario, ItsPeopleSimulateLikeOnesThatAreLoadedForIt) {
  CheckedScenario checked = checked_square();
  crowd::Simulation taken = checked.take_people();
  crowd::Simulation alone =
      sim::load_people(checked.scenario(), run_seed(checked.job(), 1), checked.job().crowd);
  for (crowd::Simulation* people : {&taken, &alone}) {
    people->prepare_to_step();
    for (int step = 0; step < 10; ++step) people->step();
  }
  EXPECT_THAT(taken.positions(), ElementsAreArray(alone.positions()));
  EXPECT_EQ(checked.people().time_s(), 0) << "loaded again";
}

}  // namespace
}  // namespace throng::jobs
