#include "jobs/manifest.h"

#include <fmt/core.h>

#include "base/error.h"
#include "base/files.h"

namespace throng::jobs {

std::vector<FileEntry> read_manifest_files(const std::filesystem::path& dataset) {
  const std::filesystem::path file = dataset / kManifestName;
  try {
    return nlohmann::json::parse(read_file(file)).at("files").get<std::vector<FileEntry>>();
  } catch (const nlohmann::json::exception& error) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", file.string(), error.what()));
  }
}

}  // namespace throng::jobs
