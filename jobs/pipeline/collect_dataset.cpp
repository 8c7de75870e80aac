#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "annotate/people/coco.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/version.h"
#include "formats/card.h"
#include "formats/export/exporter.h"
#include "jobs/pipeline/pipeline.h"
#include "jobs/pipeline/runs/run_input.h"
#include "jobs/queue/dataset/manifest.h"
#include "jobs/queue/dataset/publication.h"
#include "jobs/queue/failed_runs.h"
#include "jobs/queue/pinned_library.h"
#include "spec/job/environment.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/spec.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

// The dataset shares the bytes with the work folder where the file system can.
class Collector {
 public:
  Collector(const JobFolder& folder, const JobSpec& job)
      : folder_(folder), job_(job), failed_(read_failed_runs(folder)), staging_(folder.dataset()) {}

  void collect() {
    json runs = json::array();
    json metrics = json::array();
    for (const RunPlan& run : plan_runs(job_)) {
      if (has_failed(run.index)) continue;
      const json measured = take({Task::Kind::measure, run.index});
      metrics.push_back({{"run", run_name(run.index)}, {"seed", measured.at("seed")}});
      metrics.back().update(measured.at("metrics"));
      runs.push_back(take_frames(run.index));
      runs.back()["seed"] = measured.at("seed");
      if (!job_.mix.empty()) {
        runs.back()["scenario"] = in_scenario_of_run(job_, run.index).scenario;
      }
      runs.back()["drawn"] = samples_of_run(job_, run.index);
      runs.back()["environment"] = to_json(environment_of_run(job_.environment, run.seed));
    }
    add("metrics.json", json{{"runs", metrics}}.dump(kJsonIndent) + "\n");
    if (wants(job_, annotate::GroundTruth::coco)) {
      const std::string path = ground_truth_file(annotate::GroundTruth::coco, "");
      fs::create_directories((staging_.path() / path).parent_path());
      annotate::merge_coco(coco_shards_, staging_.path() / path, job_.name,
                           {wants(job_, annotate::GroundTruth::keypoints), job_.drones.size() > 1,
                            wants(job_, annotate::GroundTruth::vehicles),
                            wants(job_, annotate::GroundTruth::skeletons)});
      list(path);
    }
    json manifest = manifest_of(std::move(runs));
    if (wants(job_, annotate::GroundTruth::coco) || !job_.outputs.formats.empty()) {
      add_exports(manifest);
    }
    write_manifest(std::move(manifest));
    staging_.commit();
  }

 private:
  // The record of a task's output. If that is damaged it is removed, so that the task is done
  // again.
  static json checked_record(const fs::path& output) {
    try {
      json record = read_record(output);
      check_published(output, record);
      return record;
    } catch (const DamagedOutput&) {
      std::error_code error;
      fs::remove_all(output, error);
      throw;
    }
  }

  // Takes over the files of a task's output and returns its record.
  json take(const Task& task) {
    const fs::path output = folder_.output_of(task);
    json record = checked_record(output);
    for (const auto& file : record.at("files").get<std::vector<FileEntry>>()) {
      link_or_copy(published_file(output, file.path), staging_.path() / file.path);
      files_.push_back(file);
    }
    return record;
  }

  // Shards that another version of the program planned leave frames out or hold them twice.
  void check_count(int run, std::int64_t images) const {
    const std::int64_t expected =
        job_.frames_per_camera() * static_cast<std::int64_t>(job_.drones.size());
    if (images == expected) return;
    throw EnvironmentError(
        fmt::format("{}: found {} images, expected {}: another version of throng began this job; "
                    "submit it again",
                    (folder_.path() / "work" / run_name(run)).string(), images, expected));
  }

  json take_frames(int run) {
    std::int64_t images = 0;
    std::int64_t annotations = 0;
    std::set<std::uint32_t> agents;
    for (const Shard& shard : plan_shards(job_, run)) {
      const Task task{Task::Kind::render, run, shard.index};
      const json record = take(task);
      images += record.at("images").get<std::int64_t>();
      annotations += record.at("annotations").get<std::int64_t>();
      agents.merge(record.at("agents").get<std::set<std::uint32_t>>());
      devices_.insert(record.at("device").get<std::string>());
      coco_shards_.push_back(folder_.output_of(task) / "coco");
    }
    check_count(run, images);
    images_ += images;
    annotations_ += annotations;
    agents_ += agents.size();
    return {{"run", run_name(run)},
            {"frames", images},
            {"annotations", annotations},
            {"agents", agents.size()}};
  }

  void add(const std::string& path, const std::string& bytes) {
    write_new_file(staging_.path() / path, bytes);
    list(path);
  }

  void list(const std::string& path) {
    const fs::path file = staging_.path() / path;
    FileHashes hashes = hashes_of_file(file);
    files_.push_back({path, static_cast<std::int64_t>(fs::file_size(file)),
                      std::move(hashes.sha256_hex), hashes.crc32});
  }

  bool has_failed(int run) const {
    return std::any_of(failed_.begin(), failed_.end(),
                       [&](const FailedRun& failed) { return failed.run == run; });
  }

  json manifest_of(json runs) const {
    json failed = json::array();
    for (const FailedRun& run : failed_) {
      failed.push_back({{"run", run_name(run.run)}, {"task", run.task}});
    }
    // The same dataset wherever it is brought.
    JobSpec job = job_;
    job.outputs.publish.clear();
    return {{"schema_version", kManifestVersion},
            {"generator", kGenerator},
            {"job", to_json(job)},
            {"devices", devices_},
            {"people", {{"content_hash", pinned_library(folder_)}}},
            {"counts", {{"frames", images_}, {"annotations", annotations_}, {"agents", agents_}}},
            {"runs", std::move(runs)},
            {"failed_runs", std::move(failed)}};
  }

  // Other formats, and what the dataset says of its images: one pass over its annotations.
  void add_exports(const json& manifest) {
    const formats::DatasetInfo info =
        formats::describe_dataset(staging_.path(), manifest, job_.outputs.exports);
    std::optional<formats::DatasetCard> card;
    if (info.has(annotate::GroundTruth::coco)) {
      card.emplace(info, manifest, formats::Output(staging_.path()));
    }
    const fs::path folder = staging_.path() / "formats";
    const auto chosen = formats::choose_formats(job_.outputs.formats, job_.outputs.annotations, "");
    for (const Problem& warning : formats::split_warnings(info, chosen)) {
      fmt::print(stderr, "warning: {}\n", warning.text());
    }
    for (const Problem& warning :
         formats::export_dataset(info, chosen, folder, card ? &*card : nullptr)) {
      fmt::print(stderr, "warning: {}\n", warning.text());
    }
    if (card) {
      for (const char* path : {"dataset.json", "README.md"}) list(path);
    }
    if (!fs::exists(folder)) return;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file()) list(entry.path().lexically_relative(staging_.path()).string());
    }
  }

  void write_manifest(json manifest) {
    std::sort(files_.begin(), files_.end(),
              [](const FileEntry& a, const FileEntry& b) { return a.path < b.path; });
    manifest["files"] = files_;
    write_new_file(staging_.path() / kManifestName, manifest.dump(kJsonIndent) + "\n");
  }

  const JobFolder& folder_;
  const JobSpec& job_;
  std::vector<FailedRun> failed_;  ///< left out
  StagingFolder staging_;
  std::vector<FileEntry> files_;
  std::vector<fs::path> coco_shards_;
  std::set<std::string> devices_;
  std::int64_t images_ = 0;
  std::int64_t annotations_ = 0;
  std::size_t agents_ = 0;
};

}  // namespace

void collect_dataset(const JobFolder& folder, const JobSpec& job) {
  Collector(folder, job).collect();
}

}  // namespace throng::jobs
