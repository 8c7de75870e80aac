#include "jobs/study/values.h"

#include <nlohmann/json.hpp>
#include <numeric>

#include "jobs/study/page.h"

namespace throng::study {

using nlohmann::json;

namespace {

template <typename Value>
json values_json(const std::vector<Outcome>& runs, const Value& value) {
  json list = json::array();
  for (const Outcome& run : runs) list.push_back(rounded(value(run)));
  return list;
}

json percentiles_json(const std::vector<Outcome>& runs, int percent) {
  return values_json(runs, [percent](const Outcome& run) { return run.percentile_s(percent); });
}

json policy_json(const Case& one, const PolicyRow& policy, const std::vector<Outcome>& runs) {
  json means = json::array();
  for (const double until_s : one.horizons_s) {
    means.push_back(values_json(
        runs, [until_s](const Outcome& run) { return run.restricted_mean_s(until_s); }));
  }
  return {{"id", policy.id},
          {"means_s", std::move(means)},
          {"t50_s", percentiles_json(runs, 50)},
          {"t90_s", percentiles_json(runs, 90)},
          {"t95_s", percentiles_json(runs, 95)},
          {"not_escaped", values_json(runs, [](const Outcome& run) -> double {
             return run.escapes.not_escaped();
           })}};
}

}  // namespace

json values_json(const Study& study, const KnownRuns& runs) {
  json cases = json::array();
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    const Case& one = study.cases[c];
    json policies = json::array();
    for (std::size_t p = 0; p < study.policies.size(); ++p) {
      policies.push_back(policy_json(one, study.policies[p], runs.outcomes[c][p]));
    }
    cases.push_back({{"id", one.id},
                     {"horizons_s", one.horizons_s},
                     {"runs", runs.numbers[c]},
                     {"policies", std::move(policies)}});
  }
  return {{"baseline", study.policies[study.baseline].id}, {"cases", std::move(cases)}};
}

KnownRuns all_runs(const Outcomes& outcomes) {
  KnownRuns runs{outcomes, {}};
  for (const auto& policies : outcomes) {
    std::vector<int>& numbers = runs.numbers.emplace_back(policies.front().size());
    std::iota(numbers.begin(), numbers.end(), 0);
  }
  return runs;
}

}  // namespace throng::study
