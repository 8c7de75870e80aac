// Report of the job in a folder, for the command line and for workers.
#pragma once

#include <filesystem>
#include <string>

namespace throng::cli {

/// The report as HTML. Throws InputError and EnvironmentError.
std::string report_of_job(const std::filesystem::path& folder);

}  // namespace throng::cli
