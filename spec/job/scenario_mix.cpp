#include "spec/job/scenario_mix.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/compute/random.h"
#include "base/text/control_characters.h"
#include "spec/job/plan.h"

namespace throng::jobs {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kMaxWeight = 1000;
constexpr double kMinWeight = 0.001;

json generate_json(const ScenarioShare& share) {
  if (!share.generate) return {};
  json place = scenarios::to_json(*share.generate);
  if (share.is_new_each_run) place.erase("seed");
  return place;
}

void set_generate(ScenarioShare& share, const json& value, const FieldLocation& place) {
  share.generate = scenarios::read_generator_spec(value, place.pointer, place.problems);
  share.is_new_each_run = value.is_object() && !value.contains("seed");
  share.scenario = scenarios::generated_scenario_id(*share.generate);
}

const FieldTable<ScenarioShare>& share_fields() {
  static const FieldTable<ScenarioShare> fields = [] {
    FieldTable<ScenarioShare> table;
    table
        .add(
            "id", "Id", "", texts(1, 200),
            [](const ScenarioShare& share) {
              return share.generate ? json() : json(share.scenario);
            },
            [](ScenarioShare& share, const json& value, const FieldLocation& /*place*/) {
              value.get_to(share.scenario);
            },
            "Id of a scenario.")
        .without_default();
    table.add("generate", "Generate", "",
              raw({{"type", "object"}}, "the parameters of a generated scenario"), generate_json,
              set_generate,
              "Parameters of a generated scenario; without a seed, another one for each run.");
    table.add("weight", "Weight", "", numbers(kMinWeight, kMaxWeight), at(&ScenarioShare::weight),
              "Runs are shared out by the weights.");
    table.add("agents", "Agents", "people", integers(1, kMaxJobAgents), at(&ScenarioShare::agents),
              "Number of people that take part in these runs, instead of crowd.agents.");
    return table;
  }();
  return fields;
}

ScenarioShare read_share(const json& value, const FieldLocation& place) {
  ScenarioShare share;
  if (value.is_string()) {
    value.get_to(share.scenario);
    return share;
  }
  share_fields().read(value, share, place);
  if (value.contains("id") == value.contains("generate")) {
    place.problems.push_back({"", place.pointer, value.dump(),
                              "either \"id\" or \"generate\" in each scenario of a list"});
  }
  return share;
}

bool is_plain(const ScenarioShare& share) {
  return !share.generate && !share.agents && share.weight == 1;
}

}  // namespace

void read_mix(JobSpec& job, const json& list, const FieldLocation& place) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    job.mix.push_back(read_share(list[i], place.below(std::to_string(i))));
  }
  if (job.mix.empty()) return;  // the schema refuses it
  job.scenario = job.mix.front().scenario;
  job.generate = job.mix.front().generate;
}

json mix_json(const std::vector<ScenarioShare>& mix) {
  json list = json::array();
  for (const ScenarioShare& share : mix) {
    list.push_back(is_plain(share) ? json(share.scenario) : share_fields().print(share));
  }
  return list;
}

ordered_json share_rules() {
  ordered_json rules = {{"title", "Scenario share"},
                        {"description", "One of several scenarios of a job."},
                        {"type", {"string", "object"}},
                        {"minLength", 1},
                        {"maxLength", 200},
                        {kOneLine, true}};
  rules.update(share_fields().schema());
  return rules;
}

namespace {

/// The shares of the first `count` runs.
std::vector<std::size_t> shares_of_first(const JobSpec& job, int count) {
  std::vector<std::size_t> shares(static_cast<std::size_t>(count), 0);
  if (job.mix.empty()) return shares;
  const double total =
      std::accumulate(job.mix.begin(), job.mix.end(), 0.0,
                      [](double sum, const ScenarioShare& share) { return sum + share.weight; });
  constexpr double kEqual = 1e-9;  // the first of equals, whatever the sums round to
  // Runs that each share is owed by now; the share that is owed most gets the next one.
  std::vector<double> owed(job.mix.size(), 0);
  for (std::size_t& share : shares) {
    for (std::size_t i = 0; i < owed.size(); ++i) {
      owed[i] += job.mix[i].weight / total;
      if (owed[i] > owed[share] + kEqual) share = i;
    }
    owed[share] -= 1;
  }
  return shares;
}

}  // namespace

std::vector<std::size_t> shares_of_runs(const JobSpec& job) {
  return shares_of_first(job, job.runs);
}

JobSpec in_scenario_of_run(const JobSpec& job, int run) {
  if (job.mix.empty()) return job;
  const ScenarioShare& share = job.mix.at(shares_of_first(job, run + 1).back());
  JobSpec one = job;
  one.mix.clear();
  one.scenario = share.scenario;
  one.generate = share.generate;
  if (share.agents) one.agents = share.agents;
  if (share.is_new_each_run) {
    constexpr std::uint64_t kSeeds = 1'000'000'000;  // as GeneratorSpec permits
    one.generate->seed = derive_seed(run_seed(job, run), Stream::place, 0) % kSeeds;
    one.scenario = scenarios::generated_scenario_id(*one.generate);
  }
  return one;
}

std::vector<int> first_runs(const JobSpec& job) {
  const std::vector<std::size_t> shares = shares_of_runs(job);
  std::vector<int> runs;
  for (std::size_t share = 0; share < std::max<std::size_t>(1, job.mix.size()); ++share) {
    const auto found = std::find(shares.begin(), shares.end(), share);
    if (found != shares.end()) runs.push_back(static_cast<int>(found - shares.begin()));
  }
  return runs;
}

std::vector<int> runs_alike(const JobSpec& job, int run) {
  const std::vector<std::size_t> shares = shares_of_runs(job);
  const std::size_t share = shares.at(static_cast<std::size_t>(run));
  if (!job.mix.empty() && job.mix[share].is_new_each_run) return {run};
  std::vector<int> runs;
  for (std::size_t other = 0; other < shares.size(); ++other) {
    if (shares[other] == share) runs.push_back(static_cast<int>(other));
  }
  return runs;
}

std::string scenario_names(const JobSpec& job) {
  if (job.mix.empty()) return job.scenario;
  std::string names = fmt::format("{} scenarios: ", job.mix.size());
  for (std::size_t i = 0; i < job.mix.size(); ++i) {
    names += (i > 0 ? ", " : "") + job.mix[i].scenario;
  }
  return names;
}

}  // namespace throng::jobs
