#include "server/catalog/service_folders.h"

#include <utility>

#include "base/text/redact.h"
#include "jobs/queue/dataset/folder.h"
#include "server/catalog/scenario_store.h"

namespace throng::server {

namespace fs = std::filesystem;

ServiceFolders::ServiceFolders(fs::path data, fs::path shipped)
    : data_(std::move(data)),
      shipped_(std::move(shipped)),
      scenarios_(ScenarioStore::folder_in(data_)) {}

fs::path ServiceFolders::dataset_folder(const std::string& id) const {
  return jobs::JobFolder(job_folder(id)).dataset();
}

fs::path ServiceFolders::ground_truth_folder(const jobs::JobRow& row) const {
  switch (row.kind) {
    case jobs::JobKind::calibration:
      return calibration_folder(row.id);
    case jobs::JobKind::study:
      return study_folder(row.id);
    case jobs::JobKind::dataset:
      break;
  }
  return job_folder(row.id);
}

std::string ServiceFolders::without_paths(std::string message) const {
  return without_folders(std::move(message), {scenarios_, data_, shipped_});
}

std::vector<Problem> ServiceFolders::without_paths(std::vector<Problem> problems) const {
  for (Problem& problem : problems) {
    for (std::string* text : {&problem.source, &problem.where, &problem.found, &problem.expected}) {
      *text = without_paths(std::move(*text));
    }
  }
  return problems;
}

}  // namespace throng::server
