#include "jobs/queue/failed_runs.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "spec/job/plan.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

fs::path file_in(const JobFolder& folder) { return folder.path() / "failed_runs.json"; }

}  // namespace

void write_failed_runs(const JobFolder& folder, const std::vector<FailedRun>& runs) {
  json list = json::array();
  for (const FailedRun& run : runs) list.push_back({{"run", run.run}, {"task", run.task}});
  write_file_atomically(file_in(folder), list.dump() + "\n");
}

std::vector<FailedRun> read_failed_runs(const JobFolder& folder) {
  std::vector<FailedRun> runs;
  if (!fs::exists(file_in(folder))) return runs;
  for (const json& entry : parse_own_json(read_file(file_in(folder)), file_in(folder).string())) {
    runs.push_back({entry.at("run"), entry.at("task")});
  }
  return runs;
}

void forget_failed_runs(const JobFolder& folder) {
  if (!fs::exists(file_in(folder))) return;
  // The note goes last: as long as it is there, the dataset is known to lack runs.
  const fs::path aside = folder.path() / "dataset.tmp.partial";
  std::error_code error;
  fs::rename(folder.dataset(), aside, error);
  fs::remove_all(aside, error);
  fs::remove(file_in(folder));
}

}  // namespace throng::jobs
