#include "jobs/study/study.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/json/json_text.h"
#include "base/schemas/schemas.h"
#include "base/text/portable_name.h"
#include "base/text/words.h"
#include "base/version.h"
#include "crowd/description/menge_files/write.h"
#include "jobs/pipeline/checks/rehearsal.h"
#include "jobs/pipeline/checks/resolve.h"
#include "world/json_reader.h"
#include "world/scenario_crowd.h"
#include "world/scenarios/blueprint/load_scenario.h"

namespace throng::study {

using nlohmann::json;
using world::JsonValue;
namespace fs = std::filesystem;

namespace {

constexpr int kMaxRuns = 1000;
constexpr const char* kNoDrones = "no_drones";  // id of the policy of a study that names none
constexpr double kMaxRunS = 7200;               // of a job

// The part of a document that a job takes over as it is.
json part(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? json() : *found;
}

// Ids are names of folders, on Windows and macOS without regard to case.
void check_unique(const JsonValue& id, const std::string& text, std::set<std::string>& seen) {
  if (text.empty()) return;
  if (!seen.insert(lower_case(text)).second) id.reject("an id that nothing else here has");
  if (is_device_name(text)) id.reject("an id that can be a folder's name on Windows");
}

// Reads the document's own fields; what belongs to jobs is checked with them.
class StudyReader {
 public:
  StudyReader(const json& document, const std::string& source, const fs::path& scenarios,
              const std::optional<Cell>& only)
      : document_(document),
        source_(source),
        scenarios_(scenarios),
        only_(only),
        root_(document, source, problems_) {}

  Study read() {
    root_.fields({"cases"},
                 {"policies", "name", "seed", "runs", "baseline", "baseline_case", "horizons_s"});
    study_.name = root_["name"].exists() ? root_["name"].text() : "study";
    if (root_["seed"].exists()) {
      study_.seed = static_cast<std::uint64_t>(root_["seed"].integer(0, 1'000'000'000));
    }
    if (root_["runs"].exists()) study_.runs = root_["runs"].integer(1, kMaxRuns);
    read_policies();
    read_cases();
    schemas::add_schema_problems(schemas::Kind::study, document_, source_, problems_);
    throw_if_errors();
    make_jobs();
    throw_if_errors();
    return std::move(study_);
  }

 private:
  void throw_if_errors() {
    if (!problems_.empty()) throw InputError(std::move(problems_));
  }

  void read_policies() {
    if (!root_["policies"].exists()) {
      study_.policies.push_back({kNoDrones, "no drones"});
      return;
    }
    std::set<std::string> ids;
    for (const JsonValue& item : root_["policies"].items(1)) {
      item.fields({"id"}, {"title", "drones"});
      PolicyRow row;
      row.id = item["id"].identifier();
      check_unique(item["id"], row.id, ids);
      row.title = item["title"].exists() ? item["title"].text() : row.id;
      study_.policies.push_back(std::move(row));
    }
    if (!root_["baseline"].exists()) return;
    const std::string id = root_["baseline"].identifier();
    const auto found = std::find_if(study_.policies.begin(), study_.policies.end(),
                                    [&](const PolicyRow& row) { return row.id == id; });
    if (found == study_.policies.end()) {
      root_["baseline"].reject("the id of a policy");
    } else {
      study_.baseline = static_cast<std::size_t>(found - study_.policies.begin());
    }
  }

  void read_cases() {
    std::set<std::string> ids;
    for (const JsonValue& item : root_["cases"].items(1)) {
      item.fields({"id", "scenario"},
                  {"title", "close", "crowd", "alarm_s", "duration_s", "reference", "bound"});
      Case one;
      one.id = item["id"].identifier();
      check_unique(item["id"], one.id, ids);
      one.title = item["title"].exists() ? item["title"].text() : one.id;
      if (item["duration_s"].exists()) one.duration_s = item["duration_s"].number(1, kMaxRunS);
      one.scenario = read_scenario(item["scenario"]);
      close_exits(item["close"], one.scenario);
      one.alarm = world::find_alarm(one.scenario);
      if (item["alarm_s"].exists()) one.alarm.at_s = item["alarm_s"].number(0, one.duration_s);
      read_reference(item, one);
      read_horizons(item, one);
      study_.cases.push_back(std::move(one));
    }
    read_baseline_case();
  }

  // Cases of a study without policies are alternatives: of what else would they be cases?
  void read_baseline_case() {
    const bool are_alternatives = !root_["policies"].exists() && study_.cases.size() > 1;
    if (are_alternatives) study_.baseline_case = 0;
    if (!root_["baseline_case"].exists()) return;
    const std::string id = root_["baseline_case"].identifier();
    for (std::size_t i = 0; i < study_.cases.size(); ++i) {
      if (study_.cases[i].id != id) continue;
      study_.baseline_case = i;
      return;
    }
    root_["baseline_case"].reject("the id of a case");
  }

  world::Scenario read_scenario(const JsonValue& value) {
    const std::string id = value.text();
    if (id.empty()) return {};
    try {
      world::Scenario scenario = scenarios::find_scenario(scenarios_, id);
      if (!scenario.has_crowd()) {
        value.reject(fmt::format("\"{}\", whose people are recorded", id),
                     "a scenario with a crowd to simulate");
      }
      return scenario;
    } catch (const InputError& error) {
      const Problem& problem = error.problems().front();
      if (!problem.source.empty()) throw;  // the scenario's own file is wrong
      value.reject(problem.found, problem.expected);
      return {};
    }
  }

  // Closes exits of a blueprint, whose people know of it; those of Menge's files would not.
  void close_exits(const JsonValue& value, world::Scenario& scenario) {
    std::vector<std::string> ids;
    for (const world::Exit& exit : scenario.exits) ids.push_back(exit.id);
    const std::size_t before = problems_.size();
    std::vector<std::string> closed;
    for (const JsonValue& item : value.items()) {
      closed.push_back(item.text());
      if (closed.back().empty() || ids.empty() ||
          std::find(ids.begin(), ids.end(), closed.back()) != ids.end())
        continue;
      item.reject(fmt::format("the id of an exit: {}", fmt::join(ids, ", ")));
    }
    if (ids.empty() || closed.empty() || problems_.size() > before) return;
    if (!scenario.built_crowd) {
      value.reject(fmt::format("exits of \"{}\", which is no blueprint", scenario.id),
                   "exits of a blueprint: only its people know what is closed");
      return;
    }
    scenario = scenarios::find_scenario(scenarios_, scenario.id, closed);
  }

  // Those of the file must be watched for in every case. By default the longer one is as long as
  // the case is watched, and the shorter one, which few stragglers reach, 150 s or half of that.
  void read_horizons(const JsonValue& item, Case& one) {
    constexpr double kShorterS = 150;
    const auto is_right = [](const JsonValue& time) { return !time.exists() || time.is_number(); };
    if (!is_right(item["duration_s"]) || !is_right(item["alarm_s"])) return;  // reported
    const double watched_s = one.duration_s - one.alarm.at_s.value_or(0);
    if (watched_s <= 0) {
      const bool own_alarm = item["alarm_s"].exists();
      item[own_alarm ? "alarm_s" : "duration_s"].reject(
          fmt::format("an end of the run ({} s) after the alarm ({} s)", one.duration_s,
                      one.alarm.at_s.value_or(0)));
      return;
    }
    one.horizons_s = {std::min(kShorterS, 0.5 * watched_s), watched_s};
    if (!root_["horizons_s"].exists()) return;
    const auto given = root_["horizons_s"].tuple(2, "two times, the shorter one first");
    if (given.size() != 2) return;
    for (std::size_t i = 0; i < given.size(); ++i) {
      one.horizons_s[i] = given[i].number(1, kMaxRunS);
      if (one.horizons_s[i] > watched_s) {
        given[i].reject(fmt::format("at most the {} s from the alarm to the end of case \"{}\"",
                                    watched_s, one.id));
      }
    }
    if (one.horizons_s[0] >= one.horizons_s[1]) given[1].reject("a time after the first one");
  }

  void read_reference(const JsonValue& item, Case& one) {
    constexpr double kMaxSpeedMps = 20;
    constexpr double kMaxPerSecond = 1000;
    constexpr double kPerMeterSecond = 1.3;  // people; as in docs/metrics.md
    for (const world::Exit& exit : one.scenario.exits) {
      one.reference.capacity_per_s.push_back(kPerMeterSecond * exit.width_m());
    }
    // "bound" is what it was called when it was taken for one.
    const bool has_old_name = item["bound"].exists();
    if (has_old_name && item["reference"].exists()) {
      item["bound"].reject("only \"reference\", the new name of the same");
    }
    const JsonValue value = item[has_old_name ? "bound" : "reference"];
    if (!value.exists()) return;
    value.fields({}, {"speed_mps", "capacity_per_s"});
    if (value["speed_mps"].exists()) {
      one.reference.speed_mps = value["speed_mps"].number(0.1, kMaxSpeedMps);
    }
    if (!value["capacity_per_s"].exists()) return;
    const auto rates = value["capacity_per_s"].tuple(
        one.scenario.exits.size(),
        fmt::format("one number for each of the {} exits", one.scenario.exits.size()));
    for (std::size_t e = 0; e < rates.size(); ++e) {
      one.reference.capacity_per_s[e] = rates[e].number(0, kMaxPerSecond);
    }
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
    const json& given = document_["cases"][c];
    json job = {
        {"scenario", study_.cases[c].scenario.id},
        {"seed", study_.seed},
        {"runs", study_.runs},
        {"capture", {{"from_s", 0}, {"to_s", study_.cases[c].duration_s}, {"rate_hz", 0.01}}}};
    const json crowd = part(given, "crowd");
    const json policies = part(document_, "policies");
    const json drones = policies.is_null() ? json() : part(policies[p], "drones");
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

  const json& document_;
  const std::string& source_;
  const fs::path& scenarios_;
  const std::optional<Cell>& only_;
  std::vector<Problem> problems_;
  JsonValue root_;
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
