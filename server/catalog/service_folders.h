// Paths of a service's folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "jobs/queue/store/store.h"

namespace throng::server {

/// Safe to use from many threads.
class ServiceFolders {
 public:
  /// `data` is the service's data folder, `shipped` the folder of shipped scenarios.
  ServiceFolders(std::filesystem::path data, std::filesystem::path shipped);

  const std::filesystem::path& data() const { return data_; }
  /// The learned speed of this machine (jobs/queue/machine_speed.h).
  std::filesystem::path speed_file() const { return data_ / "speed.json"; }
  /// Folder with all scenarios: shipped ones and uploads.
  const std::filesystem::path& scenarios() const { return scenarios_; }
  const std::filesystem::path& shipped() const { return shipped_; }
  /// Folder of a job (jobs/queue/dataset/folder.h).
  std::filesystem::path job_folder(const std::string& id) const { return data_ / "jobs" / id; }
  /// Folder of a job's dataset, which exists once the job has succeeded.
  std::filesystem::path dataset_folder(const std::string& id) const;
  std::filesystem::path calibrations() const { return data_ / "calibrations"; }
  /// Folder of a calibration and its results.
  std::filesystem::path calibration_folder(const std::string& id) const {
    return calibrations() / id;
  }
  std::filesystem::path studies() const { return data_ / "studies"; }
  /// Folder of a study (spec/study/study_files.h).
  std::filesystem::path study_folder(const std::string& id) const { return studies() / id; }
  /// The folder of a job, a calibration or a study.
  std::filesystem::path ground_truth_folder(const jobs::JobRow& row) const;

  /// Messages without the paths of this machine's folders.
  std::string without_paths(std::string message) const;
  std::vector<Problem> without_paths(std::vector<Problem> problems) const;

 private:
  std::filesystem::path data_;
  std::filesystem::path shipped_;
  std::filesystem::path scenarios_;
};

}  // namespace throng::server
