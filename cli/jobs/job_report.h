// The report of a job in its folder, for the command line and for workers.
#pragma once

#include <filesystem>
#include <string>

namespace throng::cli {

/// The HTML file. Throws InputError and EnvironmentError.
std::string report_of_job(const std::filesystem::path& folder);

}  // namespace throng::cli
