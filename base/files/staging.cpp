#include "base/files/staging.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <random>

#include "base/files/files.h"
#include "base/resource_exhaustion.h"

namespace throng {

namespace fs = std::filesystem;

namespace {

// Set once, before the process has other threads.
struct StagingArea {
  fs::path folder;
  int descriptor = AT_FDCWD;
  std::mutex mutex;
  std::vector<fs::path> published;  ///< guarded by mutex
};

StagingArea& area() {
  static StagingArea the_area;
  return the_area;
}

bool is_staging_in_folder() { return area().descriptor != AT_FDCWD; }

std::error_code last_error() { return {errno, std::generic_category()}; }

/// The path as it is looked up from the area's descriptor.
fs::path from_area(const fs::path& staged) {
  return is_staging_in_folder() ? staged.lexically_relative(area().folder) : staged;
}

}  // namespace

void stage_in(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw_environment_error("cannot open " + folder.string(), errno);
  area().folder = folder;
  area().descriptor = descriptor;
}

bool is_staging_revoked() {
  if (!is_staging_in_folder()) return false;
  // The folder's path may lead to another one by now, or to none.
  return ::faccessat(area().descriptor, "claim", F_OK, 0) != 0 &&
         (errno == ENOENT || errno == ESTALE);
}

std::vector<fs::path> published_files() {
  const std::lock_guard lock(area().mutex);
  return area().published;
}

fs::path staging_path(const fs::path& final_path) {
  static const std::string host = name_of_this_host();
  static const std::uint32_t random = std::random_device()();
  static std::atomic<unsigned> count{0};
  const std::string name = fmt::format("{}.tmp.{}.{}.{:08x}.{}", final_path.filename().string(),
                                       host, ::getpid(), random, count++);
  const fs::path folder = is_staging_in_folder() ? area().folder : final_path.parent_path();
  return folder / name;
}

bool is_staging_name(std::string_view name) {
  constexpr auto kParts = 4;  // behind ".tmp": host, process, random number, count
  const auto mark = name.rfind(".tmp.");
  const auto last = name.rfind('.');
  return mark != std::string_view::npos &&
         std::count(name.begin() + static_cast<std::ptrdiff_t>(mark) + 1, name.end(), '.') >=
             kParts &&
         last + 1 < name.size() &&
         name.find_first_not_of("0123456789", last + 1) == std::string_view::npos;
}

std::error_code publish_staged(const fs::path& staged, const fs::path& final_path) {
  if (::renameat(area().descriptor, from_area(staged).c_str(), AT_FDCWD, final_path.c_str()) != 0) {
    return last_error();
  }
  // A file in a folder under construction is published with that folder.
  if (is_staging_in_folder() && !is_within(final_path, area().folder)) {
    const std::lock_guard lock(area().mutex);
    area().published.push_back(final_path);
  }
  return {};
}

std::error_code link_staged(const fs::path& staged, const fs::path& final_path) {
  const int result =
      ::linkat(area().descriptor, from_area(staged).c_str(), AT_FDCWD, final_path.c_str(), 0);
  return result == 0 ? std::error_code() : last_error();
}

std::string name_of_this_host() {
  if (const char* node = std::getenv("SLURMD_NODENAME"); node != nullptr && *node != '\0') {
    return node;
  }
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "localhost";
  return name.data();
}

}  // namespace throng
