#include "server/jobs/datasets.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

namespace throng::server {

namespace fs = std::filesystem;

namespace {

/// Another one for every manifest that there ever was.
std::string name_of_manifest(const fs::path& dataset) {
  struct stat status {};
  ::lstat((dataset / jobs::kManifestName).c_str(), &status);
  return fmt::format("{} {} {} {} {}", status.st_dev, status.st_ino, status.st_size,
                     status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
}

}  // namespace

std::shared_ptr<const jobs::Manifest> Datasets::manifest_of(const fs::path& dataset) {
  return manifests_.get(name_of_manifest(dataset) + dataset.string(),
                        [&] { return jobs::read_manifest(dataset); });
}

std::shared_ptr<const jobs::Archive> Datasets::archive_of(const fs::path& dataset,
                                                          const std::string& root,
                                                          jobs::ArchiveFormat format,
                                                          const jobs::Selection& selection) {
  const std::shared_ptr<const jobs::Manifest> manifest = manifest_of(dataset);
  const std::string name =
      fmt::format("{} {} {} {} {} {}", manifest->itself.sha256, dataset.string(), root,
                  static_cast<int>(format), selection.include, selection.runs);
  return archives_.get(name,
                       [&] { return jobs::Archive(dataset, *manifest, root, format, selection); });
}

}  // namespace throng::server
