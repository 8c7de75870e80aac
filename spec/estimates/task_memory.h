// How much memory a worker needs for a task, estimated before it runs: no more tasks are begun
// at once than the machine has memory for, and a job that it can never run is refused.
#pragma once

#include <cstdint>
#include <vector>

#include "spec/job/job_spec.h"
#include "spec/job/plan.h"

namespace throng::jobs {

/// Estimates in MiB of resident memory, on the high side. Measured with the shipped scenarios on
/// the software renderer (docs/service.md): images dominate, people take a few KiB each.
class TaskMemory {
 public:
  /// `people` are in each run if the job does not say how many.
  explicit TaskMemory(const JobSpec& job, int people = 0);

  /// Any task of the job.
  std::int64_t mib_of(const Task& task) const;
  /// The largest of them.
  std::int64_t max_mib() const;

 private:
  struct Run {
    std::int64_t simulate_mib;
    std::int64_t measure_mib;
    std::int64_t render_mib;
  };
  std::vector<Run> runs_;
};

/// Likewise of a calibration whose largest image has so many pixels.
std::int64_t calibration_memory_mib(std::int64_t max_image_pixels);

/// The memory that a report needs, which reads the results of a job run by run.
inline constexpr std::int64_t kReportMemoryMib = 512;

/// The memory that publishing needs: the manifest of a large dataset, and what a bucket lists.
inline constexpr std::int64_t kPublishMemoryMib = 256;

}  // namespace throng::jobs
