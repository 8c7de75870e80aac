#include "jobs/queue/dataset/folder.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "jobs/queue/dataset/manifest.h"
#include "jobs/queue/dataset/publication.h"
#include "spec/calibration/request_files.h"
#include "spec/job/spec.h"
#include "spec/study/study_files.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

/// Nothing, or what is left of a file whose writing was broken off.
bool is_as_good_as_empty(const fs::path& folder, const fs::path& file) {
  if (!fs::is_directory(folder)) return false;
  const std::string draft = file.filename().string() + ".tmp.";
  const fs::directory_iterator entries(folder);
  return std::all_of(begin(entries), end(entries), [&](const auto& entry) {
    return entry.path().filename().string().starts_with(draft);
  });
}

std::string job_text(const JobSpec& job) { return to_json(job).dump(kJsonIndent) + "\n"; }

/// Whether the text of a job file is this job, whatever it says of publishing. The file may be of
/// an earlier version, whose names of fields are deprecated now.
bool is_same_job(const std::string& written, const JobSpec& job, const fs::path& file) {
  if (written == job_text(job)) return true;
  try {
    JobSpec other = read_resolved_job(written, file.string()).spec();
    other.outputs.publish = job.outputs.publish;
    return job_text(other) == job_text(job);
  } catch (const std::exception&) {
    return false;  // damaged, or of another version: another job
  }
}

void keep_recording(const RecordedSpec& recorded, const fs::path& job_folder) {
  const fs::path kept = kept_recording(recorded, job_folder);
  if (!fs::exists(kept)) write_file_atomically(kept, read_file(recorded.file));
}

/// A task's output that is not what the task publishes, which is never an empty folder.
bool is_damaged_output(const fs::path& path) {
  std::error_code error;
  const std::string name = path.filename().string();
  if (name == "metrics" || name.starts_with("shard")) {
    return !fs::is_directory(path, error) || fs::is_empty(path, error);
  }
  return !fs::is_regular_file(path, error);
}

}  // namespace

JobFolder JobFolder::create(fs::path path, const ResolvedJob& resolved) {
  const JobSpec& job = resolved.spec();
  JobFolder folder(std::move(path));
  const std::string text = job_text(job);
  if (!fs::exists(folder.job_file())) {
    if (fs::exists(folder.path()) && !is_as_good_as_empty(folder.path(), folder.job_file())) {
      throw InputError(
          Problem{"", folder.path().string(),
                  fs::is_directory(folder.path()) ? "a folder with other files in it" : "a file",
                  "a new or empty folder, or one of the same job"});
    }
    write_file_atomically(folder.job_file(), text);
  } else if (const std::string written = read_file(folder.job_file()); written != text) {
    if (!is_same_job(written, job, folder.job_file())) {
      throw InputError(Problem{"", folder.path().string(), "a folder with another job in it",
                               "a new or empty folder, or one of the same job"});
    }
    // It is published elsewhere now, or no more.
    fs::remove(folder.output_of({Task::Kind::publish}));
    write_file_atomically(folder.job_file(), text);
  }
  if (job.recorded) keep_recording(*job.recorded, folder.path());
  return folder;
}

JobFolder JobFolder::restore(fs::path path, const ResolvedJob& resolved) {
  JobFolder folder(std::move(path));
  if (!fs::is_directory(folder.path())) fs::remove(folder.path());
  folder.remove_damaged();
  const fs::path file = folder.job_file();
  if (!fs::is_regular_file(file)) fs::remove_all(file);
  if (!fs::exists(file) || !is_same_job(read_file(file), resolved.spec(), file)) {
    write_file_atomically(file, job_text(resolved.spec()));
  }
  return create(folder.path(), resolved);
}

ResolvedJob JobFolder::read_job() const {
  return read_resolved_job(read_file(job_file()), job_file().string());
}

fs::path JobFolder::output_of(const Task& task) const {
  if (task.kind == Task::Kind::collect) return dataset();
  if (task.kind == Task::Kind::publish) return path_ / "published.json";
  if (task.kind == Task::Kind::calibrate) return path_ / calibrate::kCameraName;
  if (task.kind == Task::Kind::report) return path_ / "report.html";
  if (task.kind == Task::Kind::study_report) return path_ / study::kSummaryName;
  check(task.kind != Task::Kind::study_run, "results of a study's runs are named by the study");
  const fs::path output = path_ / "work" / to_string(task);
  return task.kind == Task::Kind::simulate ? fs::path(output).replace_extension(".h5") : output;
}

fs::path JobFolder::log_file(const Task& task) const { return log_file(to_string(task)); }

fs::path JobFolder::log_file(std::string name) const {
  std::replace(name.begin(), name.end(), '/', '_');
  return path_ / "logs" / (name + ".log");
}

bool JobFolder::is_done(const Task& task) const { return fs::exists(output_of(task)); }

void JobFolder::remove_damaged() const {
  std::error_code error;
  for (const char* name : {"work", "logs", "attempts", "recorded", "dataset"}) {
    if (!fs::is_directory(path_ / name, error)) fs::remove_all(path_ / name, error);
  }
  if (!fs::is_regular_file(dataset() / kManifestName, error)) fs::remove_all(dataset(), error);
  for (const auto& run : fs::directory_iterator(path_ / "work", error)) {
    if (run.path().filename() == "people") continue;  // heal_library_pin()
    if (!run.is_directory(error)) fs::remove_all(run.path(), error);
    if (run.path().filename() == "light") continue;  // render::load_or_make()
    for (const auto& output : fs::directory_iterator(run.path(), error)) {
      if (is_damaged_output(output.path())) fs::remove_all(output.path(), error);
    }
  }
}

void JobFolder::remove_leftovers() const {
  remove_temporaries(path_);
  std::error_code error;
  for (const auto& run : fs::directory_iterator(path_ / "work", error)) {
    remove_temporaries(run.path());
  }
}

}  // namespace throng::jobs
