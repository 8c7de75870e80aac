#include "jobs/queue/confine/machine_memory.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace throng::jobs {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kKibPerMib = 1024;
constexpr std::int64_t kBytesPerMib = 1 << 20;

std::int64_t meminfo_mib(std::string_view name) {
  std::ifstream file("/proc/meminfo");
  std::string key;
  std::int64_t kib = 0;
  std::string unit;
  while (file >> key >> kib) {
    std::getline(file, unit);
    if (key == name) return kib / kKibPerMib;
  }
  return 0;
}

std::optional<std::int64_t> mib_in(const fs::path& file) {
  std::ifstream stream(file);
  std::int64_t bytes = 0;
  if (!(stream >> bytes)) return std::nullopt;  // "max", or there is no such file
  return bytes / kBytesPerMib;
}

/// The folder of this process's control group (version 2); empty where there is none.
fs::path control_group() {
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("0::/")) continue;
    return fs::path("/sys/fs/cgroup") / line.substr(std::string_view("0::/").size());
  }
  return {};
}

struct Group {
  std::int64_t max_mib = std::numeric_limits<std::int64_t>::max();
  std::int64_t left_mib = std::numeric_limits<std::int64_t>::max();
};

/// The tightest of the limits of the group and those around it.
Group tightest_group() {
  Group tightest;
  const fs::path root = "/sys/fs/cgroup";
  for (fs::path group = control_group(); !group.empty(); group = group.parent_path()) {
    if (const auto max = mib_in(group / "memory.max")) {
      tightest.max_mib = std::min(tightest.max_mib, *max);
      const std::int64_t used = mib_in(group / "memory.current").value_or(0);
      tightest.left_mib = std::min(tightest.left_mib, std::max<std::int64_t>(0, *max - used));
    }
    if (group == root || group == group.parent_path()) break;
  }
  return tightest;
}

}  // namespace

std::int64_t total_memory_mib() {
  return std::min(meminfo_mib("MemTotal:"), tightest_group().max_mib);
}

std::int64_t available_memory_mib() {
  return std::min(meminfo_mib("MemAvailable:"), tightest_group().left_mib);
}

}  // namespace throng::jobs
