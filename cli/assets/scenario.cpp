// throng scenario: checking and drawing places.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/drawing/drawing.h"
#include "base/json/json_text.h"
#include "base/text/words.h"
#include "cli/assets/import_program.h"
#include "cli/common/exit_code.h"
#include "cli/common/import_options.h"
#include "cli/jobs/job_runner.h"
#include "cli/shell/commands.h"
#include "cli/shell/document_kind.h"
#include "cli/shell/input_file.h"
#include "cli/shell/scenario_named.h"
#include "cli/shell/trace_file.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/run_input.h"
#include "places/scenarios/blueprint/blueprint.h"
#include "places/scenarios/blueprint/generate.h"
#include "places/scenarios/blueprint/generated.h"
#include "places/scenarios/check/check.h"
#include "places/scenarios/plan/plan.h"
#include "sim/planning/planned_paths.h"
#include "spec/job/scenario_mix.h"
#include "world/drone_path.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;

/// An existing path, else the file of a shipped scenario's id.
fs::path scenario_path(const std::string& name) {
  if (fs::is_regular_file(name)) {
    require_scenario(read_input_file(name, "a scenario"), name);
  }
  if (fs::exists(name)) return name;
  if (fs::path(name).extension() == ".json") {
    refuse_missing_scenario(name);
  }
  return world::scenario_file(world::scenarios_folder(), name);
}

void add_scenario_check(CLI::App& scenario) {
  auto* command = scenario.add_subcommand("check",
                                          "Check a scenario file, a folder of scenarios or a "
                                          "scenario id; exit code 2 if there are errors");
  const auto name = std::make_shared<std::string>();
  command->add_option("scenario", *name, "FILE.json, a folder or an id")->required();
  command->callback([name] {
    const std::vector<scenarios::Finding> findings = scenarios::check_files(scenario_path(*name));
    std::size_t errors = 0;
    for (const scenarios::Finding& finding : findings) {
      fmt::print("{}\n", finding.text());
      if (finding.severity == scenarios::Severity::error) ++errors;
    }
    fmt::print("{}, {}\n", counted(errors, "error"), counted(findings.size() - errors, "warning"));
    if (errors > 0) throw CLI::RuntimeError(exit_input);
  });
}

struct PlanArguments {
  std::string name;
  std::string trace;
  fs::path output;
  int size_px = 1200;
};

/// Whether this is a job's file: only a job names a scenario.
bool is_job(const std::string& name) {
  if (fs::path(name).extension() != ".json" || !fs::is_regular_file(name)) return false;
  const nlohmann::json value = parse_json_or_discard(read_file(name));
  return value.is_object() && value.contains("scenario");
}

void draw_plan(const PlanArguments& arguments) {
  check_output_file("--output", arguments.output, {arguments.name, arguments.trace});
  std::vector<world::DronePath> paths;
  std::optional<world::Scenario> scenario;
  if (is_job(arguments.name)) {
    const jobs::JobSpec job = jobs::in_scenario_of_run(read_job_file(arguments.name).spec(), 0);
    scenario = jobs::load_job_scenario(job, world::scenarios_folder());
    paths = sim::planned_paths(*scenario, jobs::run_spec(job, 0));
  } else {
    scenario = scenario_named(arguments.name);
  }
  if (!arguments.trace.empty()) paths = world::flown_paths(read_trace_file(arguments.trace));
  drawing::write_drawing(scenarios::draw_plan(*scenario, arguments.size_px, paths),
                         arguments.output);
}

void add_plan(CLI::App& scenario) {
  auto* command = scenario.add_subcommand(
      "plan", "Plot the floor plan of a scenario, or of a job with its drones' paths");
  const auto arguments = std::make_shared<PlanArguments>();
  command->add_option("scenario", arguments->name, "FILE.json, an id or a job's file")->required();
  command->add_option("--trace", arguments->trace, "Plot the flight paths of this run (TRACE.h5)");
  command->add_option("-o,--output", arguments->output, "PLAN.svg, PLAN.png or PLAN.pdf")
      ->required();
  command->add_option("--size", arguments->size_px, "Longer side in pixels")
      ->check(CLI::Range(200, 8000));
  command->callback([arguments] { draw_plan(*arguments); });
}

void add_make(CLI::App& scenario) {
  auto* command = scenario.add_subcommand(
      "make", "Make a scenario's files, including its Menge files, from a blueprint");
  const auto file = std::make_shared<fs::path>();
  const auto folder = std::make_shared<fs::path>(".");
  command->add_option("blueprint", *file, "ID.blueprint.json (docs/blueprint.md)")->required();
  command->add_option("-o,--output", *folder, "Folder for ID.json and its Menge files");
  command->callback([file, folder] {
    require_kind(DocumentKind::blueprint, read_input_file(*file, "a blueprint"), *file);
    const std::string id = world::id_from_file(*file);
    const fs::path made = scenarios::make_scenario(*file, *folder, id);
    fmt::print("{}\n", made.string());
  });
}

struct GenerateArguments {
  std::string kind = "plaza";
  nlohmann::json spec = nlohmann::json::object();
  int seed = 1;
  int count = 1;
  fs::path folder = ".";
  /// Options that give a field, by its pointer.
  std::map<std::string, std::string> options = {{"/kind", "--kind"}, {"/seed", "--seed"}};
};

/// Problems of a spec as those of the options that gave it.
[[noreturn]] void refuse(const GenerateArguments& arguments, std::vector<Problem> problems) {
  for (Problem& problem : problems) {
    const auto option = arguments.options.find(problem.where);
    problem.source = "throng scenario generate";
    problem.where = option != arguments.options.end() ? option->second : "";
  }
  throw InputError(std::move(problems));
}

void generate(const GenerateArguments& arguments) {
  for (int i = 0; i < arguments.count; ++i) {
    nlohmann::json spec = arguments.spec;
    spec["kind"] = arguments.kind;
    spec["seed"] = arguments.seed + i;
    std::vector<Problem> problems;
    const scenarios::GeneratorSpec place = scenarios::read_generator_spec(spec, "", problems);
    if (!problems.empty()) refuse(arguments, std::move(problems));
    const std::string id = scenarios::generated_name(place);
    try {
      const fs::path made =
          scenarios::make_scenario(scenarios::generate_blueprint(place), id, arguments.folder, id);
      fmt::print("{}\n", made.string());
    } catch (const InputError& error) {
      refuse(arguments, scenarios::problems_of_spec(error.problems()));
    }
  }
}

void add_generate(CLI::App& scenario) {
  auto* command = scenario.add_subcommand("generate", "Generate scenarios from a seed");
  const auto arguments = std::make_shared<GenerateArguments>();
  command->add_option("--kind", arguments->kind, "Kind of place")
      ->type_name(fmt::format("TEXT:{{{}}}", fmt::join(scenarios::kPlaceKinds, ",")));
  command->add_option("--seed", arguments->seed, "Seed of the first scenario");
  command->add_option("--count", arguments->count, "Number of scenarios, with consecutive seeds")
      ->check(CLI::Range(1, 100'000));
  command->add_option("-o,--output", arguments->folder, "Folder for the scenarios");
  const auto number = [&](const char* option, const char* field, const char* help) {
    arguments->options[std::string("/") + field] = option;
    command->add_option_function<double>(
        option, [arguments, field](double value) { arguments->spec[field] = value; }, help);
  };
  const auto integer = [&](const char* option, const char* field, const char* help) {
    arguments->options[std::string("/") + field] = option;
    command->add_option_function<int>(
        option, [arguments, field](int value) { arguments->spec[field] = value; }, help);
  };
  number("--size", "size_m", "Length of the longer side, 30 to 200 m");
  integer("--exits", "exits", "Number of exits, 2 to 8");
  number("--exit-width", "exit_width_m", "Width of the exits, 2 to 12 m");
  number("--building-density", "building_density",
         "Share of the ground covered by buildings, 0 to 1");
  number("--clutter", "clutter", "Density of props, 0 to 1");
  number("--demand", "demand_per_minute", "People entering through each exit per minute");
  integer("--people", "people", "Number of people at the start");
  command->callback([arguments] { generate(*arguments); });
}

void add_import(CLI::App& scenario) {
  auto* command = scenario.add_subcommand(
      "import", "Import a Gazebo world or an OpenStreetMap extract as a scenario");
  const auto options = std::make_shared<ImportOptions>();
  add_import_options(*command, *options);
  command->callback([options, command] { start_import(kImportScenario, *command); });
}

}  // namespace

void add_scenario(CLI::App& app) {
  auto* command =
      app.add_subcommand("scenario", "Make, generate, check, plot and import scenarios");
  command->require_subcommand(1);
  add_scenario_check(*command);
  add_plan(*command);
  add_make(*command);
  add_generate(*command);
  add_import(*command);
}

}  // namespace throng::cli
