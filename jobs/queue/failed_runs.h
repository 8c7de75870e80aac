// Which runs of a job came to no end, for those who gather the others: a file in the job's folder.
#pragma once

#include <string>
#include <vector>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

struct FailedRun {
  int run = 0;
  std::string task;  ///< that failed
};

/// Notes them before the dataset is gathered. Throws EnvironmentError.
void write_failed_runs(const JobFolder& folder, const std::vector<FailedRun>& runs);

/// None when nothing is noted. Throws EnvironmentError.
std::vector<FailedRun> read_failed_runs(const JobFolder& folder);

/// Makes ready for another try: a dataset without them is taken away, and the note. Safe to repeat
/// after any interruption.
void forget_failed_runs(const JobFolder& folder);

}  // namespace throng::jobs
