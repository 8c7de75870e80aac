#include "jobs/queue/dataset/selection.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "base/error.h"
#include "spec/annotate/ground_truth.h"

namespace throng::jobs {

namespace {

constexpr std::string_view kRun = "run";

/// The number in "run012", also with a suffix: "run012.json".
std::optional<int> run_in(std::string_view segment) {
  if (!segment.starts_with(kRun)) return std::nullopt;
  segment.remove_prefix(kRun.size());
  int number = 0;
  const auto [end, error] =
      std::from_chars(segment.data(), segment.data() + segment.size(), number);
  const bool ends_well =
      end == segment.data() + segment.size() || *end == '.' || *end == '_' || *end == '-';
  if (error != std::errc() || !ends_well) return std::nullopt;
  return number;
}

/// The run that a file belongs to, if its path says so.
std::optional<int> parse_run(std::string_view path) {
  while (true) {
    const std::size_t slash = path.find('/');
    if (const auto run = run_in(path.substr(0, slash))) return run;
    if (slash == std::string_view::npos) return std::nullopt;
    path.remove_prefix(slash + 1);
  }
}

bool is_below(std::string_view path, std::string_view folder) {
  return path == folder || (path.starts_with(folder) && path[folder.size()] == '/');
}

bool includes(const std::string& name, std::string_view path) {
  if (const auto* kind = annotate::find_kind(name))
    return is_below(path, ground_truth_folder(*kind));
  return is_below(path, name) || is_below(path, "formats/" + name);
}

}  // namespace

bool Selection::holds(std::string_view path) const {
  if (!include.empty() && std::none_of(include.begin(), include.end(),
                                       [&](const auto& name) { return includes(name, path); })) {
    return false;
  }
  if (runs.empty()) return true;
  const std::optional<int> run = parse_run(path);
  return !run || std::binary_search(runs.begin(), runs.end(), *run);
}

std::vector<int> parse_runs(const std::string& text, int runs, const std::string& pointer) {
  const auto malformed = [&] {
    return InputError(Problem{"", pointer, '"' + text + '"',
                              fmt::format("runs from 0 to {}, such as 0-3,7", runs - 1)});
  };
  std::set<int> chosen;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  const auto number = [&] {
    int value = -1;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || value < 0 || value >= runs) throw malformed();
    at = next;
    return value;
  };
  while (true) {
    const int first = number();
    int last = first;
    if (at != end && *at == '-') {
      ++at;
      last = number();
    }
    if (last < first) throw malformed();
    for (int run = first; run <= last; ++run) chosen.insert(run);
    if (at == end) break;
    if (*at++ != ',') throw malformed();
  }
  return {chosen.begin(), chosen.end()};
}

}  // namespace throng::jobs
