// Estimates of the memory that a worker needs for a task. The scheduler starts only as many tasks
// at once as fit into the machine's memory and refuses jobs that can never fit.
#pragma once

#include <cstdint>
#include <vector>

#include "spec/job/job_spec.h"
#include "spec/job/plan.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// Estimates of resident memory in MiB, on the high side, from measurements with the shipped
/// scenarios and the software renderer (docs/service.md). Images dominate; each person takes a few
/// KiB.
class TaskMemory {
 public:
  /// `load` is ResolvedJob::load().
  explicit TaskMemory(const JobSpec& job, SceneLoad load = {});

  /// Memory of a task of the job.
  std::int64_t mib_of(const Task& task) const;
  /// Memory of the job's largest task.
  std::int64_t max_mib() const;

 private:
  struct Run {
    std::int64_t simulate_mib;
    std::int64_t measure_mib;
    std::int64_t render_mib;
  };
  std::vector<Run> runs_;
};

/// Memory (MiB) of a calibration whose largest image has `max_image_pixels`.
std::int64_t calibration_memory_mib(std::int64_t max_image_pixels);

/// Memory of a report, which reads the results of a job run by run.
inline constexpr std::int64_t kReportMemoryMib = 512;

/// Memory of publishing: the manifest of a large dataset and the listing of a bucket.
inline constexpr std::int64_t kPublishMemoryMib = 256;

}  // namespace throng::jobs
