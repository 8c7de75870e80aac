#include "crowd/elements/named_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "base/text/suggest.h"

namespace throng::crowd {

namespace fs = std::filesystem;

namespace {

/// Names in a folder, in order; none if it cannot be read.
std::vector<std::string> names_in(const fs::path& folder) {
  constexpr std::size_t kMaxNames = 1000;
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error);
       !error && entry != fs::directory_iterator() && names.size() < kMaxNames;
       entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path absolute_folder(const fs::path& path) {
  std::error_code ignored;
  fs::path folder = fs::absolute(path, ignored).lexically_normal().parent_path();
  return folder.empty() ? path.parent_path() : folder;
}

}  // namespace

fs::path named_file(const fs::path& folder, std::string_view name) {
  fs::path as_written = folder / name;
  if (name.find('\\') == std::string_view::npos || is_file(as_written)) return as_written;
  std::string with_slashes(name);
  std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
  return (folder / with_slashes).lexically_normal();
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::string describe_missing_file(const fs::path& path) {
  fs::path missing = absolute_folder(path);
  std::error_code ignored;
  if (fs::is_directory(missing, ignored)) {
    const std::vector<std::string> there = names_in(missing);
    const std::vector<std::string_view> known(there.begin(), there.end());
    return fmt::format("a file in the folder {}{}", missing.string(),
                       did_you_mean(path.filename().string(), known));
  }
  const fs::path wanted = missing;
  while (missing.has_relative_path() && !fs::exists(missing.parent_path(), ignored)) {
    missing = missing.parent_path();
  }
  const std::vector<std::string> there = names_in(missing.parent_path());
  const std::vector<std::string_view> known(there.begin(), there.end());
  return fmt::format("a file in the folder {}, which is missing{}", wanted.string(),
                     did_you_mean(missing.filename().string(), known));
}

}  // namespace throng::crowd
