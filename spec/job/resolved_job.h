// A job that can be run: checked against its scenario and completed with what the scenario knows.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "spec/job/job_spec.h"

namespace throng::jobs {

/// Made by resolve() (jobs/pipeline/checks/resolve.h), once per job. Its JSON, to_json(job.spec()),
/// is what is queued and what lies in the job's folder; its readers do not check it again.
class ResolvedJob {
 public:
  /// The caller vouches for the job.
  explicit ResolvedJob(JobSpec spec, int people = 0) : spec_(std::move(spec)), people_(people) {}

  const JobSpec& spec() const { return spec_; }
  /// That the scenario has if the job does not say how many; 0: not known.
  int people() const { return people_; }

 private:
  JobSpec spec_;
  int people_;
};

/// Reads back the JSON of a resolved job. `source` is its file, beside which a recording lies, or a
/// name for messages. Opens no file. Throws EnvironmentError and InputError for a text that no
/// resolved job has.
ResolvedJob read_resolved_job(std::string_view json, const std::string& source);

}  // namespace throng::jobs
