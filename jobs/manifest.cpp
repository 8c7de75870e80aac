#include "jobs/manifest.h"

#include <fmt/core.h>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"

namespace throng::jobs {

namespace {

using nlohmann::json;

/// The list's entries are taken as they are parsed: all of them as JSON need ten times the memory.
std::vector<FileEntry> files_in(const std::string& text) {
  std::vector<FileEntry> files;
  bool in_files = false;
  const auto take = [&](int depth, json::parse_event_t event, json& parsed) {
    constexpr int kFieldDepth = 1;
    constexpr int kEntryDepth = 2;
    if (event == json::parse_event_t::key && depth == kFieldDepth) in_files = parsed == "files";
    if (!in_files || event != json::parse_event_t::object_end || depth != kEntryDepth) return true;
    files.push_back(parsed.get<FileEntry>());
    return false;
  };
  static_cast<void>(json::parse(text, take).at("files"));
  return files;
}

}  // namespace

Manifest read_manifest(const std::filesystem::path& dataset) {
  const std::filesystem::path file = dataset / kManifestName;
  const std::string text = read_file(file);
  try {
    return {
        files_in(text),
        {kManifestName, static_cast<std::int64_t>(text.size()), sha256_hex(text), crc32_of(text)}};
  } catch (const json::exception& error) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", file.string(), error.what()));
  }
}

}  // namespace throng::jobs
