// A job that can be run: checked against its scenario and completed with the scenario's values.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "spec/job/job_spec.h"

namespace throng::jobs {

/// The result of resolve() (jobs/pipeline/checks/resolve.h), made once per job. Its JSON,
/// to_json(job.spec()), is queued and stored in the job's folder; readers do not check it again.
class ResolvedJob {
 public:
  /// Does not check `spec`: the caller guarantees that it is resolved.
  explicit ResolvedJob(JobSpec spec, int people = 0) : spec_(std::move(spec)), people_(people) {}

  const JobSpec& spec() const { return spec_; }
  /// Number of people in the scenario, for a job that does not set `agents`; 0: unknown.
  int people() const { return people_; }

 private:
  JobSpec spec_;
  int people_;
};

/// Reads the JSON of a resolved job. `source` is the job's file, to which the path of a recording
/// is relative, or a name for messages. Opens no file. Throws EnvironmentError or InputError if the
/// text is not the JSON of a resolved job.
ResolvedJob read_resolved_job(std::string_view json, const std::string& source);

}  // namespace throng::jobs
