// Parsing and printing of jobs. Parsing checks a job against the JSON Schema
// (spec/job/job.schema.json) and for consistency; it opens no file. resolve()
// (jobs/pipeline/checks/resolve.h) checks the fields that depend on the scenario and on the files
// that a job names.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "spec/job/job_spec.h"
#include "spec/job/schema.h"

namespace throng::jobs {

/// Parses the text of a job, the only time that it is parsed, within kJobJsonLimits. Throws
/// InputError if it is not JSON. `source` names the text in errors here and below
/// ("demo.job.json", or "" for a request body).
nlohmann::json parse_job_document(std::string_view text, const std::string& source);

/// Throws InputError if the document violates the schema, with a JSON pointer per problem.
void check_job_schema(const nlohmann::json& document, const std::string& source);

/// Reads a document that obeys the schema. Adds mistakes that the schema does not detect to
/// `problems`.
JobSpec read_job(nlohmann::json document, const std::string& source,
                 std::vector<Problem>& problems);

/// check_job_schema() and read_job() of a document, or of the one that a text is. Throw InputError
/// with all problems.
JobSpec check_and_read_job(nlohmann::json document, const std::string& source);
JobSpec parse_job(std::string_view text, const std::string& source);

/// The job as JSON, with all defaults that do not depend on the scenario filled in. parse_job()
/// reads the same job from it.
nlohmann::json to_json(const JobSpec& job);

/// The styling of the job's people in this weather: umbrellas only in rain, and those who lead
/// something as in the simulation.
skinning::Styling styling_in(const JobSpec& job, render::Weather weather);

/// Whether fields differ between runs, by several scenarios or `randomize`.
bool differs_between_runs(const JobSpec& job);

/// The job of a single run: with the run's scenario and the sampled values of `randomize`.
JobSpec job_of_run(const JobSpec& job, int run);

/// All values sampled for a run, by dotted path: fields of `randomize`, the environment and the
/// cameras, and the scenario if the job has several.
nlohmann::json samples_of_run(const JobSpec& job, int run);

}  // namespace throng::jobs
