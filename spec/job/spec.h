// The job: what a user asks for. Parsing checks it against one JSON Schema
// (spec/job/job.schema.json) and against itself; it opens no file. Fields that depend on the
// scenario, and on the files that a job names, are checked by resolve()
// (jobs/pipeline/checks/resolve.h).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "spec/job/job_spec.h"
#include "spec/job/schema.h"

namespace throng::jobs {

/// Throws InputError for a text that is no JSON or not what the schema allows, with a JSON pointer
/// per problem. `source` names the text in errors ("demo.job.json", or "" for a request body).
void check_job_schema(std::string_view json, const std::string& source);

/// Parses a job; what is wrong beyond the schema is added to `problems`. Throws like
/// check_job_schema().
JobSpec parse_job(std::string_view json, const std::string& source, std::vector<Problem>& problems);

/// The same, throwing InputError with all problems.
JobSpec parse_job(std::string_view json, const std::string& source);

/// The job as JSON with every default filled in that does not depend on the scenario; parse_job
/// reads it back to the same job.
nlohmann::json to_json(const JobSpec& job);

/// How people look in this weather: umbrellas are up when it rains.
skinning::Styling styling_in(const JobSpec& job, render::Weather weather);

/// Whether runs have other fields than the job: several scenarios, or `randomize`.
bool differs_between_runs(const JobSpec& job);

/// The job as one of its runs has it: its scenario, and the fields of `randomize` with their
/// sampled values.
JobSpec job_of_run(const JobSpec& job, int run);

/// Everything that was sampled for a run, by dotted path: fields of `randomize`, of the environment
/// and of the cameras; also the scenario, of a job that has several.
nlohmann::json samples_of_run(const JobSpec& job, int run);

}  // namespace throng::jobs
