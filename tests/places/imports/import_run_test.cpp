// Imported places load, have no errors that the check finds, and people leave them.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/files/resources.h"
#include "places/imports/gazebo/sdf_world.h"
#include "places/imports/osm/osm_map.h"
#include "places/imports/parts/populate.h"
#include "places/imports/parts/scenario_name.h"
#include "places/imports/parts/scenario_writer.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "places/scenarios/check/check.h"
#include "sim/run.h"
#include "tests/world/temporary_folder.h"
#include "world/scenario.h"

namespace throng::imports {
namespace {

const std::filesystem::path kData = source_folder() / "tests/places/imports/data";

class Counter : public sim::RunObserver {
 public:
  void step(const world::CrowdStep& step) override {
    max_present_ =
        std::max(max_present_, std::count(step.flags.begin(), step.flags.end(), world::kPresent));
  }
  void event(const world::TraceEvent& event) override {
    if (std::holds_alternative<world::AgentEscaped>(event.kind)) ++escaped_;
  }
  long escaped_ = 0;
  long max_present_ = 0;
};

void expect_it_runs(ImportedScenario imported, int people) {
  const throng::testing::TemporaryFolder folder;
  const Population population = populate(imported, {people, 3});
  EXPECT_EQ(population.starts.size(), static_cast<std::size_t>(people));
  const auto file = write_imported_scenario(imported, population, folder.path());
  const world::Scenario scenario = scenarios::find_scenario(folder.path(), imported.name);
  EXPECT_EQ(scenario.exits.size(), population.gates.size());
  for (const scenarios::Finding& finding : scenarios::check_files(file)) {
    EXPECT_NE(finding.severity, scenarios::Severity::error) << finding.text();
  }
  sim::RunSpec spec;
  spec.duration_s = 60;
  Counter counter;
  for (const Problem& warning : sim::simulate(scenario, spec, counter)) {
    ADD_FAILURE() << warning.text();
  }
  EXPECT_GE(counter.max_present_, people);
  EXPECT_GT(counter.escaped_, people / 3);
}

TEST(ImportRun, AGazeboWorld) {
  expect_it_runs(read_sdf(kData / "yard.sdf", {{kData / "models"}, {}}), 60);
}

TEST(ImportRun, AGazeboWorldWithAnExitOfOnesOwn) {
  ImportedScenario scenario =
      read_sdf(kData / "yard.sdf", {{kData / "models"}, {{{-14, 0}, {-14, 5}, 1}}});
  const Population population = populate(scenario, {10, 1});
  ASSERT_EQ(population.gates.size(), 1U);
  EXPECT_EQ(population.gates[0].from, Eigen::Vector2d(-14, 0));
}

TEST(ImportRun, AMap) { expect_it_runs(read_osm(kData / "quarter.osm", {}), 60); }

TEST(ImportRun, APlaceThatNobodyCanLeaveIsRefused) {
  ImportedScenario scenario;
  scenario.name = "cell";
  scenario.inside = {{0, 0}, {20, 20}};
  for (const world::Rectangle& wall : {world::Rectangle{{-1, -1}, {21, 0.5}},
                                       {{-1, 19.5}, {21, 21}},
                                       {{-1, -1}, {0.5, 21}},
                                       {{19.5, -1}, {21, 21}}}) {
    scenario.obstacles.push_back(rectangle_corners(wall));
  }
  EXPECT_THROW(populate(scenario, {}), InputError);
}

TEST(ImportRun, NamesAreThoseOfScenarios) {
  EXPECT_EQ(scenario_name_from("a/My World-2.sdf"), "my_world_2");
  EXPECT_EQ(scenario_name_from("äöü.osm"), "scenario");
}

}  // namespace
}  // namespace throng::imports
