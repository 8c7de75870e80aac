// Cache of manifests and archive layouts for downloads. With hundreds of thousands of files, they
// take a second and much memory to create, and clients request many ranges.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "jobs/queue/dataset/archive.h"
#include "jobs/queue/dataset/manifest.h"
#include "server/http/lru_cache.h"

namespace throng::server {

/// Safe to use from many threads. Detects that a dataset was replaced by another one.
class Datasets {
 public:
  /// The manifest of a dataset. Throws EnvironmentError.
  std::shared_ptr<const jobs::Manifest> manifest_of(const std::filesystem::path& dataset);
  /// The archive of a dataset with these parameters (jobs::Archive). Throws EnvironmentError.
  std::shared_ptr<const jobs::Archive> archive_of(const std::filesystem::path& dataset,
                                                  const std::string& root,
                                                  jobs::ArchiveFormat format,
                                                  const jobs::Selection& selection);

 private:
  LruCache<jobs::Manifest> manifests_{2};
  LruCache<jobs::Archive> archives_{2};
};

}  // namespace throng::server
