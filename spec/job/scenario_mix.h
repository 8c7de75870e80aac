// Jobs with several scenarios: the assignment of runs to scenarios.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "spec/job/field_table.h"
#include "spec/job/job_spec.h"

namespace throng::jobs {

/// Reads a job's "scenario" if it is a list: ids, or objects {"id" or "generate", "weight",
/// "agents"}.
void read_mix(JobSpec& job, const nlohmann::json& list, const FieldLocation& place);
/// The list as JSON; the inverse of read_mix().
nlohmann::json mix_json(const std::vector<ScenarioShare>& mix);
/// The JSON Schema of an element of the list.
nlohmann::ordered_json share_rules();

/// The scenario of each run, as an index into job.mix (0 in a job with one scenario). Runs are
/// divided by weight, and scenarios alternate, so that splits, which take consecutive runs, contain
/// every scenario. Independent of the seed; more runs do not change the scenarios of the first
/// ones.
std::vector<std::size_t> shares_of_runs(const JobSpec& job);

/// The job with the scenario of one of its runs: `mix` is empty, `randomize` unchanged.
JobSpec in_scenario_of_run(const JobSpec& job, int run);

/// The first run of each scenario that has any runs, in the order of job.mix.
std::vector<int> first_runs(const JobSpec& job);

/// The runs with the same scenario as `run`, including `run`. A scenario that is generated for each
/// run has only this one.
std::vector<int> runs_alike(const JobSpec& job, int run);

/// The job's scenarios for messages: "a", or "3 scenarios: a, b, c".
std::string scenario_names(const JobSpec& job);

}  // namespace throng::jobs
