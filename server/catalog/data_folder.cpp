#include "server/catalog/data_folder.h"

#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <chrono>
#include <set>
#include <utility>
#include <vector>

#include "base/files/files.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

constexpr auto kQuarantine = std::chrono::hours(24 * 30);

std::vector<fs::path> list_entries(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) entries.push_back(entry.path());
  return entries;
}

void quarantine_strangers(const fs::path& data, const char* kind, const jobs::Store& store) {
  for (const fs::path& folder : list_entries(data / kind)) {
    if (store.get(folder.filename().string())) continue;
    const fs::path place = data / "quarantine" / kind / folder.filename();
    fs::create_directories(place.parent_path());
    std::error_code error;
    fs::rename(folder, place, error);
    if (error) {
      spdlog::warn("{} {}: unknown, and cannot be moved: {}", kind, folder.filename().string(),
                   error.message());
      continue;
    }
    fs::last_write_time(place, fs::file_time_type::clock::now(), error);
    spdlog::warn("{} {}: not in the store, moved to quarantine", kind, folder.filename().string());
  }
}

void remove_old(const fs::path& quarantine) {
  for (const fs::path& kind : list_entries(quarantine)) {
    for (const fs::path& folder : list_entries(kind)) {
      std::error_code error;
      const auto since = fs::last_write_time(folder, error);
      if (error || fs::file_time_type::clock::now() - since < kQuarantine) continue;
      fs::remove_all(folder, error);
      spdlog::info("{}: removed from quarantine", folder.filename().string());
    }
  }
}

}  // namespace

void tidy_data_folder(const fs::path& data, const jobs::Store& store) {
  std::error_code error;
  fs::remove_all(data / "trash", error);
  quarantine_strangers(data, "jobs", store);
  for (const char* kind : {"calibrations", "studies"}) {
    remove_temporaries(data / kind);
    quarantine_strangers(data, kind, store);
  }
  remove_old(data / "quarantine");
}

std::int64_t measure_disk_bytes(const fs::path& folder) {
  constexpr std::int64_t kBlock = 512;  // the unit of st_blocks, whatever the file system's
  std::set<std::pair<dev_t, ino_t>> counted;
  std::int64_t bytes = 0;
  std::error_code error;
  fs::recursive_directory_iterator entries(folder, error);
  for (; !error && entries != fs::recursive_directory_iterator(); entries.increment(error)) {
    struct stat status {};
    if (::lstat(entries->path().c_str(), &status) != 0) continue;
    if (status.st_nlink > 1 && !counted.emplace(status.st_dev, status.st_ino).second) continue;
    bytes += status.st_blocks * kBlock;
  }
  return bytes;
}

}  // namespace throng::server
