#include "jobs/pipeline/checks/scenario_check.h"

#include <utility>

#include "base/error.h"
#include "base/files/confine.h"
#include "crowd/simulation.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "places/scenarios/check/check.h"
#include "render/props/mesh_file.h"
#include "sim/run.h"
#include "spec/scenarios/scenario_summary.h"
#include "world/scenario.h"
#include "world/scenario_id.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

class Findings {
 public:
  explicit Findings(const fs::path& folder) : folder_(folder) {}

  /// Does it and notes what is wrong; whether nothing is.
  template <typename Work>
  bool has_done(const Work& work) {
    try {
      work();
      return true;
    } catch (const InputError& error) {
      for (Problem problem : error.problems()) {
        problem.source = relative(problem.source);
        problem.found = relative(std::move(problem.found));
        problem.expected = relative(std::move(problem.expected));
        problems_.push_back(std::move(problem));
      }
    } catch (const EnvironmentError& error) {
      // Files that cannot be read are the sender's fault here.
      problems_.push_back({"", "", relative(error.what()), "files that can be read"});
    }
    return false;
  }

  void throw_any() {
    if (!problems_.empty()) throw InputError(std::move(problems_));
  }

 private:
  std::string relative(std::string text) const {
    for (const std::string& prefix :
         {fs::absolute(folder_).string() + "/", folder_.string() + "/"}) {
      for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at)) {
        text.erase(at, prefix.size());
      }
    }
    return text;
  }

  const fs::path& folder_;
  std::vector<Problem> problems_;
};

}  // namespace

CheckedScenarios check_scenarios(const fs::path& folder) {
  CheckedScenarios checked{world::list_scenarios(folder)};
  std::vector<Problem> unnamed = world::list_unnamed_scenarios(folder);
  if (checked.ids.empty() && !unnamed.empty()) throw InputError(std::move(unnamed));
  for (Problem& problem : unnamed) {
    checked.findings.push_back({false, std::move(problem), "rename the file or the folder"});
  }
  if (checked.ids.empty()) {
    throw InputError(Problem{"", "", "no scenario",
                             "at least one file NAME.json, its name of small letters, digits and _ "
                             "(docs/scenario.md)"});
  }
  const Confinement confinement(folder);
  Findings findings(folder);
  for (const std::string& id : checked.ids) {
    world::Scenario scenario;
    const fs::path file = world::scenario_file(folder, id);
    const auto load = [&] { scenario = scenarios::load_scenario(file, id); };
    if (!findings.has_done(load)) continue;
    const auto load_people = [&] {
      // A place for recorded people has no crowd of its own.
      if (scenario.has_crowd()) static_cast<void>(sim::load_people(scenario, 1, {}));
    };
    if (findings.has_done(load_people)) {
      for (scenarios::Finding& finding :
           scenarios::check(scenario, file.lexically_relative(folder).string())) {
        checked.findings.push_back({finding.severity == scenarios::Severity::error,
                                    std::move(finding.problem), std::move(finding.remedy)});
      }
    }
    findings.has_done([&] { checked.summaries.push_back(scenario_summary(scenario)); });
    for (const world::PlacedMesh& mesh : scenario.meshes) {
      findings.has_done([&] { static_cast<void>(render::mesh_from_file(mesh, 0)); });
    }
  }
  findings.throw_any();
  return checked;
}

}  // namespace throng::jobs
