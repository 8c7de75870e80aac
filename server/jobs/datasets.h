// Cache for downloaded datasets: manifests and the plans of archives. With hundreds of thousands of
// files they take a second and much memory to make, and clients ask for many ranges.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "jobs/queue/dataset/archive.h"
#include "jobs/queue/dataset/manifest.h"
#include "server/http/lru_cache.h"

namespace throng::server {

/// Safe to use from many threads. Published datasets do not change; one that is published in place
/// of another is noticed.
class Datasets {
 public:
  /// Throws EnvironmentError.
  std::shared_ptr<const jobs::Manifest> manifest_of(const std::filesystem::path& dataset);
  /// Throws EnvironmentError.
  std::shared_ptr<const jobs::Archive> archive_of(const std::filesystem::path& dataset,
                                                  const std::string& root,
                                                  jobs::ArchiveFormat format,
                                                  const jobs::Selection& selection);

 private:
  LruCache<jobs::Manifest> manifests_{2};
  LruCache<jobs::Archive> archives_{2};
};

}  // namespace throng::server
