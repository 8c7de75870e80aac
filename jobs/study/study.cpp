#include "jobs/study/study.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/json/json_text.h"
#include "base/text/words.h"
#include "base/version.h"
#include "crowd/description/menge_files/write.h"
#include "jobs/pipeline/checks/rehearsal.h"
#include "jobs/pipeline/checks/resolve.h"
#include "metrics/exits/exit_state.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "spec/study/study_document.h"
#include "world/scenario_crowd.h"

namespace throng::study {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* kNoDrones = "no_drones";  // id of the policy of a study that names none

std::string shown(const std::string& text) { return "\"" + text + "\""; }

/// Index of the item with an id, if there is one.
template <typename Item>
std::optional<std::size_t> index_with_id(const std::vector<Item>& items, const std::string& id) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.id == id; });
  if (found == items.end()) return std::nullopt;
  return static_cast<std::size_t>(found - items.begin());
}

// Completes the document's fields; what belongs to jobs is checked with them.
class StudyReader {
 public:
  StudyReader(const json& document, const std::string& source, const fs::path& scenarios,
              const std::optional<Cell>& only)
      : source_(source),
        scenarios_(scenarios),
        only_(only),
        document_(read_study_document(document, source, problems_)) {}

  Study read() {
    study_.name = document_.name;
    study_.seed = document_.seed;
    study_.runs = document_.runs;
    read_policies();
    read_cases();
    throw_if_errors();
    make_jobs();
    throw_if_errors();
    return std::move(study_);
  }

 private:
  void throw_if_errors() {
    if (!problems_.empty()) throw InputError(std::move(problems_));
  }

  bool has_problem(const std::string& pointer) const {
    return std::any_of(problems_.begin(), problems_.end(),
                       [&](const Problem& problem) { return problem.where.starts_with(pointer); });
  }

  void reject(const std::string& pointer, std::string found, std::string expected) {
    problems_.push_back({source_, pointer, std::move(found), std::move(expected)});
  }

  void read_policies() {
    if (!document_.policies) {
      study_.policies.push_back({kNoDrones, "no drones"});
      return;
    }
    for (const PolicyDocument& policy : *document_.policies) {
      study_.policies.push_back({policy.id, policy.title.empty() ? policy.id : policy.title});
    }
    if (!document_.baseline) return;
    const auto index = index_with_id(study_.policies, *document_.baseline);
    if (!index) reject("/baseline", shown(*document_.baseline), "the id of a policy");
    study_.baseline = index.value_or(0);
  }

  void read_cases() {
    for (std::size_t i = 0; i < document_.cases.size(); ++i) {
      const CaseDocument& given = document_.cases[i];
      const std::string pointer = fmt::format("/cases/{}", i);
      Case one;
      one.id = given.id;
      one.title = given.title.empty() ? given.id : given.title;
      one.duration_s = given.duration_s;
      one.scenario = read_scenario(given.scenario, pointer + "/scenario");
      close_exits(given.closed_exits, pointer + "/close", one.scenario);
      one.alarm = world::find_alarm(one.scenario);
      if (given.alarm_s) one.alarm.at_s = given.alarm_s;
      read_reference(given.reference, one);
      if (!has_problem(pointer) && !has_problem("/horizons_s")) read_horizons(given, pointer, one);
      study_.cases.push_back(std::move(one));
    }
    read_baseline_case();
  }

  // Cases of a study without policies are alternatives: of what else would they be cases?
  void read_baseline_case() {
    const bool are_alternatives = !document_.policies && study_.cases.size() > 1;
    if (are_alternatives) study_.baseline_case = 0;
    if (!document_.baseline_case) return;
    const auto index = index_with_id(study_.cases, *document_.baseline_case);
    if (!index) reject("/baseline_case", shown(*document_.baseline_case), "the id of a case");
    if (index) study_.baseline_case = index;
  }

  world::Scenario read_scenario(const std::string& id, const std::string& pointer) {
    if (id.empty()) return {};
    try {
      world::Scenario scenario = scenarios::find_scenario(scenarios_, id);
      if (!scenario.has_crowd()) {
        reject(pointer, fmt::format("\"{}\", whose people are recorded", id),
               "a scenario with a crowd to simulate");
      }
      return scenario;
    } catch (const InputError& error) {
      const Problem& problem = error.problems().front();
      if (!problem.source.empty()) throw;  // the scenario's own file is wrong
      reject(pointer, problem.found, problem.expected);
      return {};
    }
  }

  // Closes exits of a blueprint, whose people know of it; those of Menge's files would not.
  void close_exits(const std::vector<std::string>& closed, const std::string& pointer,
                   world::Scenario& scenario) {
    std::vector<std::string> ids;
    for (const world::Exit& exit : scenario.exits) ids.push_back(exit.id);
    if (ids.empty() || closed.empty()) return;
    const std::size_t before = problems_.size();
    for (std::size_t i = 0; i < closed.size(); ++i) {
      if (std::find(ids.begin(), ids.end(), closed[i]) != ids.end()) continue;
      reject(fmt::format("{}/{}", pointer, i), shown(closed[i]),
             fmt::format("the id of an exit: {}", fmt::join(ids, ", ")));
    }
    if (problems_.size() > before) return;
    if (!scenario.built_crowd) {
      reject(pointer, fmt::format("exits of \"{}\", which is no blueprint", scenario.id),
             "exits of a blueprint: only its people know what is closed");
      return;
    }
    scenario = scenarios::find_scenario(scenarios_, scenario.id, closed);
  }

  // Those of the file must be watched for in every case. By default the longer one is as long as
  // the case is watched, and the shorter one, which few stragglers reach, 150 s or half of that.
  void read_horizons(const CaseDocument& given, const std::string& pointer, Case& one) {
    constexpr double kShorterS = 150;
    const double watched_s = one.duration_s - one.alarm.at_s.value_or(0);
    if (watched_s <= 0) {
      reject(pointer + (given.alarm_s ? "/alarm_s" : "/duration_s"),
             fmt::format("{:g}", given.alarm_s ? *given.alarm_s : one.duration_s),
             fmt::format("an end of the run ({} s) after the alarm ({} s)", one.duration_s,
                         one.alarm.at_s.value_or(0)));
      return;
    }
    one.horizons_s = document_.horizons_s.value_or(
        std::array<double, 2>{std::min(kShorterS, 0.5 * watched_s), watched_s});
    if (!document_.horizons_s) return;
    for (std::size_t i = 0; i < one.horizons_s.size(); ++i) {
      if (one.horizons_s.at(i) <= watched_s) continue;
      note({source_, fmt::format("/horizons_s/{}", i), fmt::format("{:g}", one.horizons_s.at(i)),
            fmt::format("at most the {} s from the alarm to the end of case \"{}\"", watched_s,
                        one.id)});
    }
    if (one.horizons_s[0] >= one.horizons_s[1]) {
      note({source_, "/horizons_s/1", fmt::format("{:g}", one.horizons_s[1]),
            "a time after the first one"});
    }
  }

  void read_reference(const ReferenceDocument& given, Case& one) {
    for (const world::Exit& exit : one.scenario.exits) {
      one.reference.capacity_per_s.push_back(metrics::capacity_per_s(exit));
    }
    if (given.speed_mps) one.reference.speed_mps = *given.speed_mps;
    if (!given.capacity_per_s) return;
    const std::size_t exits = one.scenario.exits.size();
    if (given.capacity_per_s->size() != exits) {
      reject(given.capacity_pointer, fmt::format("{} numbers", given.capacity_per_s->size()),
             fmt::format("one number for each of the {} exits", exits));
      return;
    }
    one.reference.capacity_per_s = *given.capacity_per_s;
  }

  void make_jobs() {
    for (std::size_t c = 0; c < study_.cases.size(); ++c) {
      const Case& one = study_.cases[c];
      std::string inputs = fmt::format("{} outcome 2 {} {}", kGenerator,
                                       one.alarm.at_s.value_or(-1), one.reference.speed_mps);
      for (const double rate : one.reference.capacity_per_s) inputs += fmt::format(" {}", rate);
      const crowd::CrowdDescription crowd = world::build_crowd(one.scenario);
      inputs += crowd::to_xml(crowd.scene) + crowd::to_xml(crowd.behavior) + one.scenario.document;
      auto& jobs = study_.jobs.emplace_back();
      auto& fingerprints = study_.fingerprints.emplace_back();
      for (std::size_t p = 0; p < study_.policies.size(); ++p) {
        if (only_ && (only_->one_case != c || only_->policy != p)) {
          jobs.emplace_back();
          fingerprints.emplace_back();
          continue;
        }
        jobs.push_back(make_job(c, p));
        json job = jobs::to_json(jobs.back());
        job.erase("runs");  // more of them leave those that there are as they are
        fingerprints.push_back(sha256_hex(inputs + job.dump()));
      }
    }
  }

  jobs::JobSpec make_job(std::size_t c, std::size_t p) {
    json job = {
        {"scenario", study_.cases[c].scenario.id},
        {"seed", study_.seed},
        {"runs", study_.runs},
        {"capture", {{"from_s", 0}, {"to_s", study_.cases[c].duration_s}, {"rate_hz", 0.01}}}};
    const json& crowd = document_.cases[c].crowd;
    const json drones = document_.policies ? (*document_.policies)[p].drones : json();
    if (!crowd.is_null()) job["crowd"] = crowd;
    const bool nobody_flies = drones.is_null() || drones == json::array();
    if (!nobody_flies) job["drones"] = drones;
    const auto default_drones =
        nobody_flies ? jobs::DefaultDrones::none : jobs::DefaultDrones::of_scenario;
    try {
      const jobs::ResolvedJob resolved =
          jobs::resolve_job(job, source_, scenarios_, default_drones);
      study_.people =
          std::max(study_.people, resolved.spec().agents.value_or(resolved.load().people));
      return resolved.spec();
    } catch (const InputError& error) {
      for (Problem problem : error.problems()) {
        const bool of_policy = problem.where.rfind("/drones", 0) == 0;
        problem.where = (of_policy ? fmt::format("/policies/{}", p) : fmt::format("/cases/{}", c)) +
                        problem.where;
        note(std::move(problem));
      }
      return {};
    }
  }

  /// Once: a mistake in a crowd is found with every policy, one in drones in every case.
  void note(Problem problem) {
    const bool is_known =
        std::any_of(problems_.begin(), problems_.end(), [&](const Problem& other) {
          return other.where == problem.where && other.text() == problem.text();
        });
    if (!is_known) problems_.push_back(std::move(problem));
  }

  const std::string& source_;
  const fs::path& scenarios_;
  const std::optional<Cell>& only_;
  std::vector<Problem> problems_;
  StudyDocument document_;
  Study study_;
};

}  // namespace

Study load_study(const fs::path& file, const fs::path& scenarios) {
  const std::string source = file.string();
  std::string text;
  try {
    text = read_file(file);
  } catch (const EnvironmentError&) {
    throw InputError({source, "", "no readable file", "a study's file"});
  }
  Study study = read_study(parse_json(text, source), source, scenarios);
  for (Case& one : study.cases) {
    for (const Problem& problem : jobs::scenario_findings(one.scenario)) {
      one.findings.push_back(problem.text());
    }
  }
  return study;
}

Study read_study(const json& document, const std::string& source, const fs::path& scenarios,
                 const std::optional<Cell>& only) {
  return StudyReader(document, source, scenarios, only).read();
}

}  // namespace throng::study
