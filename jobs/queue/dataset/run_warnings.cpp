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

}  // namespace

void keep_warnings(const fs::path& output, const std::vector<std::string>& texts) {
  write_file_atomically(warnings_file(output), nlohmann::json(texts).dump(1) + "\n");
}

std::vector<std::string> task_warnings(const fs::path& output) {
  const fs::path file = warnings_file(output);
  std::vector<std::string> warnings;
  try {
    if (!fs::exists(file)) return {};
    const nlohmann::json kept = parse_json_or_discard(read_file(file));
    if (!kept.is_array()) return {};
    for (const nlohmann::json& text : kept) {
      if (text.is_string()) warnings.push_back(text);
    }
  } catch (const EnvironmentError&) {
    return {};
  }
  return warnings;
}

std::vector<std::string> kept_warnings(const JobFolder& folder, int runs) {
  std::vector<std::string> warnings;
  std::set<std::string> seen;
  for (int run = 0; run < runs; ++run) {
    for (const Task::Kind kind : {Task::Kind::simulate, Task::Kind::measure}) {
      for (const std::string& text : task_warnings(folder.output_of({kind, run}))) {
        if (!seen.insert(text).second) continue;
        warnings.push_back(fmt::format("{}: {}", run_name(run), text));
      }
    }
  }
  return warnings;
}

}  // namespace throng::jobs
