// Result of a dry run as text for terminals.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace throng::cli {

/// Prints the result of a dry run (jobs/pipeline/checks/job_check.h) to stdout: counts, estimates,
/// views and warnings. `file` is the job's file, named in warnings; times are for `cores` cores.
void print_job_summary(const nlohmann::json& answer, const std::string& file, int cores);

}  // namespace throng::cli
