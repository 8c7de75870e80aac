#include "places/scenarios/check/check.h"

#include <fmt/core.h>

#include <algorithm>

#include "places/scenarios/blueprint/blueprint.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "places/scenarios/check/check_scenario.h"
#include "places/scenarios/check/survey.h"
#include "world/extended_document.h"
#include "world/scenario_id.h"

namespace throng::scenarios {

namespace fs = std::filesystem;

namespace {

/// The remedy of an error that a reader of files has found.
std::string suggest_remedy(const Problem& problem, bool of_blueprint) {
  if (problem.found.find("does not exist") != std::string::npos) {
    return "put the file beside the scenario, or correct its name";
  }
  if (problem.where.starts_with("line")) {
    if (problem.source.ends_with(".json")) return "correct the text there, which is no JSON";
    return "correct this element: docs/reference/crowd_vocabulary.md lists what each may say";
  }
  return fmt::format("correct this field: docs/reference/{}.md lists what each may say",
                     of_blueprint ? "blueprint" : "scenario");
}

std::vector<Finding> to_findings(const InputError& error, const std::string& source,
                                 bool of_blueprint) {
  std::vector<Finding> findings;
  for (Problem problem : error.problems()) {
    if (problem.source.empty()) problem.source = source;
    std::string remedy = suggest_remedy(problem, of_blueprint);
    findings.push_back({Severity::error, std::move(problem), std::move(remedy)});
  }
  return findings;
}

void append(std::vector<Finding> more, std::vector<Finding>& all) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

std::vector<Finding> check_file(const fs::path& file) {
  const std::string source = file.string();
  bool of_blueprint = world::is_blueprint_name(source);
  try {
    const world::ExtendedDocument document = world::read_extended(file, source);
    of_blueprint = is_blueprint(document.whole, file);
    std::vector<Finding> findings = check(load_scenario(file, world::id_from_file(file)), source);
    for (Finding& finding : findings) {
      if (finding.problem.source != source) continue;  // of the crowd's files
      finding.problem = document.in_their_files({std::move(finding.problem)}).front();
    }
    return findings;
  } catch (const InputError& error) {
    return to_findings(error, source, of_blueprint);
  }
}

}  // namespace

std::string Finding::text() const {
  return fmt::format("{}: {}\n  remedy: {}", severity == Severity::error ? "error" : "warning",
                     problem.text(), remedy);
}

std::vector<Finding> check(const world::Scenario& scenario, const std::string& source) {
  const bool of_blueprint = scenario.built_crowd != nullptr;
  Findings findings(source, of_blueprint);
  check_sizes(scenario, findings);
  check_drawn_ground(scenario, findings);
  check_buildings(scenario, findings);
  check_drones(scenario, findings);
  std::vector<Finding> all = findings.take();
  // Grids of what has the wrong size would be absurd, too.
  if (any_error(all)) return all;
  if (!scenario.has_crowd()) return all;  // only recorded people can be in it
  try {
    const LoadedCrowd loaded = load_scenario_crowd(scenario);
    const Routes routes = find_routes(scenario, loaded);
    const OutlineSurvey outline = survey_outline(scenario, loaded, routes);
    check_exits(scenario, loaded, routes, outline.is_closed(), findings);
    check_walls(scenario, routes, findings);
    check_ground(scenario, routes, findings);
    check_outline(scenario, outline, findings);
    check_outsiders(scenario, loaded, findings);
    check_people(scenario, loaded, routes, findings);
    append(findings.take(), all);
    for (const Problem& warning : loaded.warnings) {
      all.push_back({Severity::warning, warning, suggest_remedy(warning, of_blueprint)});
    }
  } catch (const InputError& error) {
    append(to_findings(error, source, of_blueprint), all);
  }
  return all;
}

std::vector<Finding> check_files(const fs::path& file_or_folder) {
  const auto name_finding = [](Problem problem) {
    return Finding{Severity::warning, std::move(problem), "rename the file or the folder"};
  };
  if (fs::is_regular_file(file_or_folder)) {
    std::vector<Finding> findings = check_file(file_or_folder);
    if (std::optional<Problem> problem = world::find_name_problem(file_or_folder.filename())) {
      findings.push_back(name_finding(*std::move(problem)));
    }
    return findings;
  }
  if (!fs::is_directory(file_or_folder)) {
    throw InputError({file_or_folder.string(), "", "nothing", "a scenario file or a folder"});
  }
  std::vector<Finding> findings;
  for (Problem& problem : world::list_unnamed_scenarios(file_or_folder)) {
    findings.push_back(name_finding(std::move(problem)));
  }
  const std::vector<std::string> ids = world::list_scenarios(file_or_folder);
  if (ids.empty() && findings.empty()) {
    throw InputError(
        {file_or_folder.string(), "", "no scenario",
         "a folder with scenario files, whose names are words of [a-z0-9_] and .json"});
  }
  for (const std::string& id : ids) {
    append(check_file(world::scenario_file(file_or_folder, id)), findings);
  }
  return findings;
}

bool any_error(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.severity == Severity::error; });
}

}  // namespace throng::scenarios
