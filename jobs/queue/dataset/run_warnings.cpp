#include "jobs/queue/dataset/run_warnings.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "spec/job/plan.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

fs::path warnings_file(const fs::path& output) { return output.string() + ".warnings.json"; }

nlohmann::json read_kept(const fs::path& file) {
  try {
    return fs::exists(file) ? parse_json_or_discard(read_file(file)) : nlohmann::json::array();
  } catch (const EnvironmentError&) {
    return nlohmann::json::array();
  }
}

}  // namespace

void keep_warnings(const fs::path& output, const std::vector<std::string>& texts) {
  write_file_atomically(warnings_file(output), nlohmann::json(texts).dump(1) + "\n");
}

std::vector<std::string> kept_warnings(const JobFolder& folder, int runs) {
  std::vector<std::string> warnings;
  std::set<std::string> seen;
  for (int run = 0; run < runs; ++run) {
    for (const Task::Kind kind : {Task::Kind::simulate, Task::Kind::measure}) {
      const nlohmann::json kept = read_kept(warnings_file(folder.output_of({kind, run})));
      if (!kept.is_array()) continue;
      for (const nlohmann::json& text : kept) {
        if (!text.is_string() || !seen.insert(text.get<std::string>()).second) continue;
        warnings.push_back(fmt::format("{}: {}", run_name(run), text.get<std::string>()));
      }
    }
  }
  return warnings;
}

}  // namespace throng::jobs
