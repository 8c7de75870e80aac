// Jobs of several scenarios: which run takes place where.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "spec/job/field_table.h"
#include "spec/job/job_spec.h"

namespace throng::jobs {

/// Reads the list of a job's "scenario": ids, or objects {"id" or "generate", "weight", "agents"}.
void read_mix(JobSpec& job, const nlohmann::json& list, const FieldLocation& place);
/// The list, as read_mix() reads it back.
nlohmann::json mix_json(const std::vector<ScenarioShare>& mix);
/// The JSON Schema of an element of the list.
nlohmann::ordered_json share_rules();

/// The share (index into job.mix; 0 in a job of one scenario) of each run: runs are shared out by
/// weight and alternate, so that consecutive runs, as splits take them, hold every scenario. Does
/// not depend on the seed; a job with more runs begins like one with fewer.
std::vector<std::size_t> shares_of_runs(const JobSpec& job);

/// The job in the scenario of one of its runs: `mix` is empty, and `randomize` as it was.
JobSpec in_scenario_of_run(const JobSpec& job, int run);

/// The first run of each share that has any, by share.
std::vector<int> first_runs(const JobSpec& job);

/// The runs that take place in the same scenario as this one, itself included: no others where it
/// is generated for each run.
std::vector<int> runs_alike(const JobSpec& job, int run);

/// "a", or "3 scenarios: a, b, c".
std::string scenario_names(const JobSpec& job);

}  // namespace throng::jobs
