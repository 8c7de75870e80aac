// Every value of metrics.json has a definition in docs/metrics.md.
#include "metrics/definitions.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "metrics/evacuation.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

/// A run in which every part of metrics.json is there.
nlohmann::json figures() {
  world::Scenario scenario = place_with_door(2);
  add_alarm(scenario, 0);
  const world::Trace trace = make_trace({walking({-5, 0}, {1, 0}), walking({-6, 0}, {1, 0})});
  return to_json(run_metrics(trace, scenario, exit_series(trace, scenario)));
}

TEST(MetricDefinitions, AreThereForEveryValue) {
  const nlohmann::json run = figures();
  std::vector<std::string> missing;
  for (const auto& [name, value] : run.items()) {
    if (!find_definition(name) && !value.is_object() && !value.is_array()) missing.push_back(name);
    if (value.is_object() && name != "definitions") {
      for (const auto& member : value.items()) {
        const std::string path = name + "." + member.key();
        if (!find_definition(path)) missing.push_back(path);
      }
    }
    if (value.is_array() && !value.empty() && value[0].is_object()) {
      for (const auto& member : value[0].items()) {
        const std::string path = name + "[]." + member.key();
        if (!find_definition(path)) missing.push_back(path);
      }
    }
  }
  EXPECT_EQ(missing, std::vector<std::string>{});
}

TEST(MetricDefinitions, LeadToTheirParagraphs) {
  const nlohmann::json addresses = figures().at("definitions");
  EXPECT_EQ(addresses.at("people"), "docs/metrics.md#people");
  EXPECT_EQ(addresses.at("exits[].congested_s"), "docs/metrics.md#exits-demand_s");
  EXPECT_EQ(addresses.at("exits[].crossings.in"), "docs/metrics.md#exits-crossings");
  EXPECT_EQ(find_definition("exits[].gaps.median_s")->anchor, "exits-gaps");
  EXPECT_EQ(find_definition("nothing"), nullptr);
  std::set<std::string> anchors;
  for (const Definition& definition : definitions_of_run()) {
    EXPECT_TRUE(anchors.insert(definition.anchor).second) << definition.anchor;
    EXPECT_GT(definition.text.size(), 10) << definition.anchor;
    EXPECT_EQ(definition.text.find("]("), std::string::npos) << definition.text;
  }
  EXPECT_GT(anchors.size(), 30);
}

}  // namespace
}  // namespace throng::metrics
