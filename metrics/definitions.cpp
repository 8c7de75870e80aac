#include "metrics/definitions.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <string_view>

namespace throng::embedded {
extern const std::string_view kMetricsDocument;
}  // namespace throng::embedded

namespace throng::metrics {

namespace {

/// A cell of a table without its links and marks of code and emphasis.
std::string plain_text(const std::string& markdown) {
  static const std::regex kLink(R"(\[([^\]]*)\]\([^)]*\))");
  static const std::regex kMark(R"([`*\\])");
  return std::regex_replace(std::regex_replace(markdown, kLink, "$1"), kMark, "");
}

/// Paths from the first cell of a row: the first name, then its members (".out") or its siblings.
std::vector<std::string> paths_in(const std::string& cell) {
  static const std::regex kCode("`([^`]+)`");
  std::vector<std::string> paths;
  for (std::sregex_iterator code(cell.begin(), cell.end(), kCode), end; code != end; ++code) {
    std::string name = (*code)[1];
    if (!paths.empty()) {
      const std::size_t parent = paths.front().rfind('.');
      if (name.front() == '.') {
        name = paths.front() + name;
      } else if (parent != std::string::npos) {
        name = paths.front().substr(0, parent + 1) + name;
      }
    }
    paths.push_back(std::move(name));
  }
  return paths;
}

std::vector<Definition> read_definitions() {
  static const std::regex kRow(R"re(^\| <a id="([^"]+)"></a>(.*?) \| (.*) \|$)re");
  std::vector<Definition> definitions;
  std::istringstream document{std::string(embedded::kMetricsDocument)};
  for (std::string line; std::getline(document, line);) {
    std::smatch row;
    if (!std::regex_match(line, row, kRow)) continue;
    definitions.push_back({paths_in(row[2]), row[1], plain_text(row[3])});
  }
  return definitions;
}

}  // namespace

const std::vector<Definition>& definitions_of_run() {
  static const std::vector<Definition> kDefinitions = read_definitions();
  return kDefinitions;
}

std::string anchor_address(const Definition& definition) {
  return "docs/metrics.md#" + definition.anchor;
}

const Definition* find_definition(const std::string& path) {
  const std::vector<Definition>& all = definitions_of_run();
  for (std::string at = path; !at.empty(); at.resize(at.find_last_of(".[") + 1)) {
    while (!at.empty() && (at.back() == '.' || at.back() == '[')) at.pop_back();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Definition& definition) {
      const auto& paths = definition.paths;
      return std::find(paths.begin(), paths.end(), at) != paths.end();
    });
    if (found != all.end()) return &*found;
  }
  return nullptr;
}

}  // namespace throng::metrics
