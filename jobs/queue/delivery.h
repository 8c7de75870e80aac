// published.json: the object store that holds the finished dataset of a job. The task "publish"
// writes the file once all objects have been uploaded.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

/// An uploaded dataset.
struct Delivery {
  std::string address;       ///< s3://BUCKET/PREFIX
  std::int64_t objects = 0;  ///< number of uploaded objects
  std::int64_t bytes = 0;    ///< total size of the objects
};

/// Writes published.json into the job's folder, atomically. Throws EnvironmentError.
void write_delivery(const JobFolder& folder, const Delivery& delivery);

/// Reads published.json; std::nullopt if the dataset has not been published. Throws
/// EnvironmentError for a damaged file.
std::optional<Delivery> read_delivery(const JobFolder& folder);

}  // namespace throng::jobs
