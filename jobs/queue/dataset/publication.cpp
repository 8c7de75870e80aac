#include "jobs/queue/dataset/publication.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>

#include "base/error.h"
#include "base/files/hash.h"
#include "base/json/json_text.h"
#include "base/resource_exhaustion.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kFiles = "files";
constexpr const char* kRecord = "record.json";
constexpr const char* kOthers = "others";

FileEntry make_entry(const fs::path& file, std::string path) {
  FileHashes hashes = hashes_of_file(file);
  return {std::move(path), static_cast<std::int64_t>(fs::file_size(file)),
          std::move(hashes.sha256_hex), hashes.crc32};
}

/// The files beside files/.
std::vector<FileEntry> other_files(const fs::path& folder) {
  std::vector<FileEntry> others;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::end(entry); ++entry) {
    if (entry->path() == folder / kFiles) entry.disable_recursion_pending();
    if (!entry->is_regular_file()) continue;
    others.push_back(make_entry(entry->path(), entry->path().lexically_relative(folder).string()));
  }
  std::sort(others.begin(), others.end(),
            [](const FileEntry& a, const FileEntry& b) { return a.path < b.path; });
  return others;
}

void check_file(const fs::path& file, const FileEntry& entry) {
  FileHashes hashes;
  try {
    hashes = hashes_of_file(file);
  } catch (const EnvironmentError&) {
    if (fs::exists(file)) throw;
    throw DamagedOutput(fmt::format("{} is gone", file.string()));
  }
  if (hashes.sha256_hex == entry.sha256) return;
  throw DamagedOutput(
      fmt::format("{} is damaged: its bytes have changed since they were written", file.string()));
}

}  // namespace

void to_json(json& value, const FileEntry& file) {
  value = {{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}};
  if (file.crc32) value["crc32"] = fmt::format("{:08x}", *file.crc32);
}

void from_json(const json& value, FileEntry& file) {
  file = {value.at("path"), value.at("bytes"), value.at("sha256")};
  if (value.contains("crc32")) {
    constexpr int kHex = 16;
    const std::string text = value.at("crc32");
    std::uint32_t crc32 = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), crc32, kHex);
    if (error != std::errc() || end != text.data() + text.size()) {
      throw json::other_error::create(501, "crc32 is no hexadecimal number of 32 bits", &value);
    }
    file.crc32 = crc32;
  }
}

void write_new_file(const fs::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  if (!file && errno == ENOENT) {  // the first one in its folder
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    errno = 0;
    file.clear();
    file.open(path, std::ios::binary);
  }
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw_write_error(path, errno);
}

Publication::Publication(const fs::path& output) : staging_(output) {}

void Publication::add(std::string path, std::string_view bytes) {
  write_new_file(published_file(staging_.path(), path), bytes);
  files_.push_back(
      {std::move(path), static_cast<std::int64_t>(bytes.size()), sha256_hex(bytes), crc32(bytes)});
}

void Publication::publish(json record) {
  record["files"] = files_;
  record[kOthers] = other_files(staging_.path());
  write_new_file(staging_.path() / kRecord, record.dump() + "\n");
  staging_.commit();
}

json read_record(const fs::path& output) {
  const fs::path file = output / kRecord;
  if (!fs::exists(file)) throw DamagedOutput(fmt::format("{} is gone", file.string()));
  const std::string text = read_file(file);
  try {
    return parse_own_json(text, file.string());
  } catch (const EnvironmentError& error) {
    throw DamagedOutput(error.what());
  }
}

void check_published(const fs::path& output, const json& record) {
  try {
    for (const auto& file : record.at(kFiles).get<std::vector<FileEntry>>()) {
      check_file(published_file(output, file.path), file);
    }
    // Earlier versions did not list them.
    for (const auto& file : record.value(kOthers, json::array()).get<std::vector<FileEntry>>()) {
      check_file(output / file.path, file);
    }
  } catch (const json::exception& error) {
    throw DamagedOutput(
        fmt::format("{} is damaged: {}", (output / kRecord).string(), error.what()));
  }
}

fs::path published_file(const fs::path& output, const std::string& path) {
  return output / kFiles / path;
}

}  // namespace throng::jobs
