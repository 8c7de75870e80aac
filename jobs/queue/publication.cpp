#include "jobs/queue/publication.h"

#include <fmt/core.h>

#include <fstream>

#include "base/error.h"
#include "base/hash.h"
#include "base/json_text.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kFiles = "files";
constexpr const char* kRecord = "record.json";

}  // namespace

void to_json(json& value, const FileEntry& file) {
  value = {{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}};
  if (file.crc32) value["crc32"] = fmt::format("{:08x}", *file.crc32);
}

void from_json(const json& value, FileEntry& file) {
  file = {value.at("path"), value.at("bytes"), value.at("sha256")};
  if (value.contains("crc32")) {
    constexpr int kHex = 16;
    file.crc32 =
        static_cast<std::uint32_t>(std::stoul(value.at("crc32").get<std::string>(), nullptr, kHex));
  }
}

void write_new_file(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw EnvironmentError(fmt::format("cannot write {}", path.string()));
}

Publication::Publication(const fs::path& output) : staging_(output) {}

void Publication::add(std::string path, std::string_view bytes) {
  write_new_file(published_file(staging_.path(), path), bytes);
  files_.push_back({std::move(path), static_cast<std::int64_t>(bytes.size()), sha256_hex(bytes),
                    crc32_of(bytes)});
}

void Publication::publish(json record) {
  record["files"] = files_;
  write_new_file(staging_.path() / kRecord, record.dump() + "\n");
  staging_.commit();
}

json read_record(const fs::path& output) {
  try {
    return parse_own_json(read_file(output / kRecord), (output / kRecord).string());
  } catch (const json::exception& error) {
    throw EnvironmentError(
        fmt::format("{} is damaged: {}", (output / kRecord).string(), error.what()));
  }
}

fs::path published_file(const fs::path& output, const std::string& path) {
  return output / kFiles / path;
}

}  // namespace throng::jobs
