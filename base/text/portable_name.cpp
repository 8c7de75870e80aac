#include "base/text/portable_name.h"

#include <algorithm>
#include <array>

#include "base/text/words.h"

namespace throng {

namespace {

bool is_plain(char c) {
  return c >= ' ' && c <= '~' && std::string_view("\\:*?\"<>|").find(c) == std::string_view::npos;
}

}  // namespace

bool is_device_name(std::string_view name) {
  constexpr std::array<std::string_view, 6> kDevices = {"con", "prn",    "aux",
                                                        "nul", "conin$", "conout$"};
  std::string stem = lower_case(name.substr(0, name.find('.')));
  stem.erase(stem.find_last_not_of(' ') + 1);  // Windows does not see them
  if (std::find(kDevices.begin(), kDevices.end(), stem) != kDevices.end()) return true;
  constexpr std::size_t kNumbered = 4;
  return stem.size() == kNumbered && (stem.starts_with("com") || stem.starts_with("lpt")) &&
         stem.back() >= '0' && stem.back() <= '9';
}

std::optional<std::string> path_fault(std::string_view path) {
  constexpr std::size_t kMaxPartBytes = 255;
  if (path.starts_with('/') || !std::all_of(path.begin(), path.end(), is_plain)) {
    return "this path";
  }
  for (std::size_t from = 0; from < path.size();) {
    const std::size_t to = std::min(path.find('/', from), path.size());
    const std::string_view part = path.substr(from, to - from);
    from = to + 1;
    if (part.empty() || part == ".") continue;
    if (part == "..") return "a path with \"..\"";
    if (part.ends_with('.') || part.ends_with(' ') || part.starts_with(' ')) {
      return "a name that begins or ends with a space or ends with a dot";
    }
    if (part.size() > kMaxPartBytes) return "a name of more than 255 characters";
    if (is_device_name(part)) return "a name that is reserved for devices";
  }
  return std::nullopt;
}

std::optional<DistinctPaths::Clash> DistinctPaths::add(std::string_view path, bool is_folder) {
  const std::size_t slash = path.rfind('/');
  const std::string_view folder = slash == std::string_view::npos ? "" : path.substr(0, slash);
  if (!folder.empty() && folder != last_folder_) {
    for (std::size_t end = folder.find('/');; end = folder.find('/', end + 1)) {
      if (auto clash = add_one(std::string(folder.substr(0, end)), true)) return clash;
      if (end == std::string_view::npos) break;
    }
    last_folder_ = folder;
  }
  return add_one(std::string(path), is_folder);
}

std::optional<DistinctPaths::Clash> DistinctPaths::add_one(const std::string& path,
                                                           bool is_folder) {
  const auto [at, is_new] = known_.try_emplace(lower_case(path), Known{path, is_folder});
  const Known& known = at->second;
  if (is_new) {
    folders_ += is_folder ? 1 : 0;
    return std::nullopt;
  }
  if (known.path != path) return Clash{known.path, false};
  if (is_folder && known.is_folder) return std::nullopt;
  return Clash{known.path, true};
}

}  // namespace throng
