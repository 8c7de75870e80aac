// Where a job takes place.
#pragma once

#include <filesystem>

#include "jobs/spec/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// The scenario that the job names, or the one that is generated for it. Throws InputError when
/// there is none of the name.
world::Scenario scenario_of(const JobSpec& job, const std::filesystem::path& scenarios);

}  // namespace throng::jobs
