// Pins the character library of a job, so that all of its frames are rendered with the same one.
#pragma once

#include <string>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

/// Records the content hash of the character library in the job's folder (work/people), or compares
/// it with the hash recorded there, because a library that is rebuilt while a job runs must not mix
/// with the old one. Safe to call from several workers at once. Throws EnvironmentError that names
/// both hashes if they differ.
void pin_library(const JobFolder& folder, const std::string& content_hash);

/// Removes a record that is no hash, and the job's rendered frames with it: nobody knows which
/// characters they show.
void heal_library_pin(const JobFolder& folder);

/// The recorded hash; "" if no worker has recorded one yet.
std::string pinned_library(const JobFolder& folder);

}  // namespace throng::jobs
