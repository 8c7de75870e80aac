// Time, disk and memory of a job, estimated from the job alone, for `throng check` and
// dry runs.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "spec/job/job_spec.h"

namespace throng::jobs {

/// Estimates: right within a factor of about two on a processor like that of docs/rendering.md.
struct JobCost {
  int runs = 0;
  std::int64_t shards = 0;
  std::int64_t images = 0;      ///< of all runs and cameras
  double cpu_s = 0;             ///< of one core, with the software renderer
  std::int64_t disk_bytes = 0;  ///< the dataset and the traces beside it
  std::int64_t memory_mib = 0;  ///< of the largest task
};

/// `people` is how many the scenario has, or the job asks for.
/// A run, as far as it is known before it.
struct ExpectedRun {
  std::int64_t people = 0;  ///< also those who come later
  double at_a_time = 0;     ///< in the scenario
  /// In an image of each drone's camera; nothing where its path depends on the people.
  std::vector<std::optional<double>> in_view;
  double ground_m2 = 0;  ///< of the scenario
  bool is_fled = false;  ///< people run from something, and their places are less alike
};

/// As if all people were there at once, and half of them in view.
JobCost estimate_cost(const JobSpec& job, std::int64_t people);
/// `expected` has each run.
JobCost estimate_cost(const JobSpec& job, const std::vector<ExpectedRun>& expected);

/// {"cpu_s", "disk_bytes", "memory_mib"}; the rest is plain fact and stands beside it in answers.
nlohmann::json estimate_json(const JobCost& cost);

}  // namespace throng::jobs
