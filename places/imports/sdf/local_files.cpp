#include "places/imports/sdf/local_files.h"

#include <algorithm>
#include <system_error>

namespace throng::imports {

namespace fs = std::filesystem;

LocalFiles::LocalFiles(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::path known = fs::canonical(folder.empty() ? "." : folder, error);
    if (!error) folders_.push_back(std::move(known));
  }
}

std::optional<fs::path> LocalFiles::find(const std::string& uri, const fs::path& from) const {
  std::string name = uri;
  if (const std::size_t scheme = uri.find("://"); scheme != std::string::npos) {
    const std::string kind = uri.substr(0, scheme);
    if (kind != "model" && kind != "file" && kind != "package") return std::nullopt;
    name = uri.substr(scheme + 3);
  }
  if (name.empty() || name.find('\0') != std::string::npos) return std::nullopt;
  std::vector<fs::path> candidates;
  if (!from.empty()) candidates.push_back(from.parent_path() / name);
  for (const fs::path& folder : folders_) candidates.push_back(folder / name);
  for (const fs::path& candidate : candidates) {
    std::error_code error;
    const fs::path path = fs::canonical(candidate, error);
    if (error) continue;
    const bool known = std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) {
      return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
             folder.end();
    });
    if (known) return path;
  }
  return std::nullopt;
}

}  // namespace throng::imports
