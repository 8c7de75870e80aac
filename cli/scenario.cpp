// throng scenario: checking and drawing places.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/scenario_import.h"
#include "cli/scenario_named.h"
#include "places/check.h"
#include "places/plan.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;

/// A path as it is, else the file of a shipped scenario's id.
fs::path path_of(const std::string& name) {
  if (fs::exists(name)) return name;
  return world::scenarios_folder() / (name + ".json");
}

void add_check(CLI::App& scenario) {
  auto* command = scenario.add_subcommand(
      "check",
      "Check a scenario file, a folder of them or the one with an id; exit code 2 if "
      "anything is wrong");
  const auto name = std::make_shared<std::string>();
  command->add_option("scenario", *name, "FILE.json, a folder or an id")->required();
  command->callback([name] {
    const std::vector<places::Finding> findings = places::check_files(path_of(*name));
    std::size_t errors = 0;
    for (const places::Finding& finding : findings) {
      fmt::print("{}\n", finding.text());
      if (finding.severity == places::Severity::error) ++errors;
    }
    fmt::print("{} errors, {} warnings\n", errors, findings.size() - errors);
    if (errors > 0) throw CLI::RuntimeError(exit_input);
  });
}

void add_plan(CLI::App& scenario) {
  auto* command = scenario.add_subcommand("plan", "Draw a scenario's floor plan");
  const auto name = std::make_shared<std::string>();
  const auto output = std::make_shared<fs::path>();
  const auto size_px = std::make_shared<int>(1200);
  command->add_option("scenario", *name, "FILE.json or an id")->required();
  command->add_option("-o,--output", *output, "PLAN.svg or PLAN.png")->required();
  command->add_option("--size", *size_px, "the longer side in pixels")
      ->check(CLI::Range(200, 8000));
  command->callback([name, output, size_px] {
    places::write_plan(places::draw_plan(scenario_named(*name), *size_px), *output);
  });
}

}  // namespace

void add_scenario(CLI::App& app) {
  auto* command = app.add_subcommand("scenario", "Check, draw and import scenarios");
  command->require_subcommand(1);
  add_check(*command);
  add_plan(*command);
  add_scenario_import(*command);
}

}  // namespace throng::cli
