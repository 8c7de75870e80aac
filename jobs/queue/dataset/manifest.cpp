#include "jobs/queue/dataset/manifest.h"

#include <fmt/core.h>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/files/path_below.h"
#include "base/json/json_text.h"

namespace throng::jobs {

namespace {

using nlohmann::json;

/// The list's entries are taken as they are parsed: all of them as JSON need ten times the memory.
std::vector<FileEntry> files_in(const std::string& text, const std::string& source) {
  std::vector<FileEntry> files;
  const json rest = parse_own_json_list(text, source, "files", [&](const json& entry) {
    files.push_back(entry.get<FileEntry>());
    require_path_below(files.back().path, source, fmt::format("/files/{}/path", files.size() - 1));
  });
  static_cast<void>(rest.at("files"));
  return files;
}

}  // namespace

Manifest read_manifest(const std::filesystem::path& dataset) {
  const std::filesystem::path file = dataset / kManifestName;
  const std::string text = read_file(file);
  try {
    return {files_in(text, file.string()),
            {kManifestName, static_cast<std::int64_t>(text.size()), sha256_hex(text), crc32(text)}};
  } catch (const json::exception& error) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", file.string(), error.what()));
  }
}

}  // namespace throng::jobs
