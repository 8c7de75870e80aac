// published.json: where the finished dataset of a job was brought. Written by the task "publish"
// once everything is there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

struct Delivery {
  std::string address;  ///< s3://...
  std::int64_t objects = 0;
  std::int64_t bytes = 0;
};

/// Throws EnvironmentError.
void write_delivery(const JobFolder& folder, const Delivery& delivery);

/// Nothing as long as the dataset was not published. Throws EnvironmentError.
std::optional<Delivery> read_delivery(const JobFolder& folder);

}  // namespace throng::jobs
