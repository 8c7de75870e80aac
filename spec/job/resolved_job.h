// A job that can be run: checked against its scenario and completed with the scenario's values.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "spec/job/job_spec.h"

namespace throng::jobs {

/// Memory (MiB) of the shipped character library in a worker that renders.
inline constexpr std::int64_t kShippedPeopleMib = 500;

/// How much a task of a job loads beside its images, for estimates (spec/estimates/).
struct SceneLoad {
  /// Number of people in the scenario, for a job that does not set `agents`; 0: unknown.
  int people = 0;
  /// Memory (MiB) of the character library and of the scenario's meshes and props.
  std::int64_t models_mib = kShippedPeopleMib;
};

void to_json(nlohmann::json& value, const SceneLoad& load);
void from_json(const nlohmann::json& value, SceneLoad& load);

/// The result of resolve() (jobs/pipeline/checks/resolve.h), made once per job. Its JSON,
/// to_json(job.spec()), is queued and stored in the job's folder; readers do not check it again.
class ResolvedJob {
 public:
  /// Does not check `spec`: the caller guarantees that it is resolved.
  explicit ResolvedJob(JobSpec spec, SceneLoad load = {}) : spec_(std::move(spec)), load_(load) {}

  const JobSpec& spec() const { return spec_; }
  /// The largest of its scenarios.
  SceneLoad load() const { return load_; }

 private:
  JobSpec spec_;
  SceneLoad load_;
};

/// Reads the JSON of a resolved job. `source` is the job's file, to which the path of a recording
/// is relative, or a name for messages. Opens no file. Throws EnvironmentError or InputError if the
/// text is not the JSON of a resolved job.
ResolvedJob read_resolved_job(std::string_view json, const std::string& source);
ResolvedJob resolved_job_from_json(nlohmann::json document, const std::string& source,
                                   SceneLoad load = {});

}  // namespace throng::jobs
