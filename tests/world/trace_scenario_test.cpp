// The scenario that a trace holds.
#include "world/fields/trace_scenario.h"
#include "base/files/resources.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"
#include "world/scenario.h"

namespace throng::world {
namespace {

Scenario shipped(const std::string& id) {
  return load_scenario(source_folder() / "scenarios" / (id + ".json"), id);
}

TraceHeader make_header(const Scenario& scenario) {
  TraceHeader header;
  header.scenario_id = scenario.id;
  header.scenario_document = scenario.document;
  header.alarm = find_alarm(scenario);
  return header;
}

TEST(ScenarioInTrace, IsTheScenarioWithoutItsCrowd) {
  for (const char* id : {"city_square/nearest_exit", "city_square/side_exit_blocked",
                         "city_square/huang2016/nearest_exit"}) {
    const Scenario scenario = shipped(id);
    const auto kept = scenario_in_trace(make_header(scenario), "run.h5", TraceMeshes::needed);
    ASSERT_TRUE(kept) << id;
    EXPECT_FALSE(kept->has_crowd());
    EXPECT_EQ(kept->id, id);
    EXPECT_EQ(kept->document, scenario.document);
    ASSERT_EQ(kept->exits.size(), scenario.exits.size());
    EXPECT_EQ(kept->exits.back().goals, scenario.exits.back().goals);
    EXPECT_EQ(kept->props.size(), scenario.props.size());
    EXPECT_EQ(find_alarm(*kept), find_alarm(scenario));
  }
}

TEST(ScenarioInTrace, SurvivesTheFile) {
  const throng::testing::TemporaryFolder folder;
  TraceHeader header = make_header(shipped("city_square/nearest_exit"));
  header.dt_s = 0.1;
  {
    TraceWriter writer(folder.path() / "run.h5", header);
    writer.add(CrowdStep{});
    writer.finish();
  }
  const TraceHeader read = read_trace(folder.path() / "run.h5").header;
  EXPECT_EQ(read.scenario_document, header.scenario_document);
  EXPECT_EQ(read.alarm, header.alarm);
}

TEST(ScenarioInTrace, TracesOfEarlierVersionsHaveNone) {
  EXPECT_FALSE(scenario_in_trace({}, "run.h5", TraceMeshes::left_out));
}

TEST(ScenarioInTrace, MeshesAreNotInIt) {
  TraceHeader header = make_header(shipped("city_square/nearest_exit"));
  nlohmann::json document = nlohmann::json::parse(header.scenario_document);
  document["meshes"] = {{{"file", "statue.glb"}, {"position", {0, 0, 0}}}};
  header.scenario_document = document.dump();
  EXPECT_FALSE(scenario_in_trace(header, "run.h5", TraceMeshes::needed));
  EXPECT_TRUE(scenario_in_trace(header, "run.h5", TraceMeshes::left_out)->meshes.empty());
}

TEST(ScenarioInTrace, ADamagedOneIsNamed) {
  TraceHeader header = make_header(shipped("city_square/nearest_exit"));
  header.scenario_document[0] = '?';
  EXPECT_THROW(scenario_in_trace(header, "run.h5", TraceMeshes::needed), InputError);
  header.scenario_document = "[]";
  EXPECT_THROW(scenario_in_trace(header, "run.h5", TraceMeshes::needed), InputError);
}

}  // namespace
}  // namespace throng::world
