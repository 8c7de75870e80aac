// The character library that a job is rendered with: the same from its first frame to its last.
#pragma once

#include <string>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

/// Notes the population's content hash in the job's folder (work/people), or checks that it is the
/// one that is noted there: a library that is rebuilt while a job runs must not mix with the old
/// one. Safe to be called by several workers at once. Throws EnvironmentError naming both.
void pin_library(const JobFolder& folder, const std::string& content_hash);

/// The hash that was noted; empty when no frame has been rendered.
std::string pinned_library(const JobFolder& folder);

}  // namespace throng::jobs
