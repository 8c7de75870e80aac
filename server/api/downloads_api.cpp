#include "server/api/downloads_api.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/files/untrusted_folders.h"
#include "base/json/json_text.h"
#include "base/text/slug.h"
#include "jobs/queue/dataset/archive.h"
#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/dataset/manifest.h"
#include "jobs/queue/trace_seal.h"
#include "server/access/keys.h"
#include "server/api/requests.h"
#include "server/catalog/service_folders.h"
#include "server/http/file_answer.h"
#include "server/http/http.h"
#include "server/jobs/datasets.h"
#include "server/jobs/image_list.h"
#include "server/jobs/job_queue.h"
#include "server/jobs/report_maker.h"
#include "spec/estimates/task_memory.h"
#include "spec/job/plan.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

jobs::JobRow find_succeeded(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                            const Request& request) {
  jobs::JobRow row = find_job(queue, caller, request);
  // One that could only not be published has its dataset, too.
  const bool is_complete = !is_active(row.state) && fs::exists(folders.dataset_folder(row.id));
  if (!has_dataset(row.state) && !is_complete) {
    throw HttpError{409, fmt::format("the job is {}; this is there once it has succeeded",
                                     to_string(row.state))};
  }
  return row;
}

/// A file of one run: of the dataset, or before that is complete of the run's own figures, which
/// are there once it was measured, whatever becomes of the others. 404 when there is no such run or
/// the job did not ask for it.
void send_run_file(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                   const Request& request, Response& response, const char* folder,
                   const char* suffix, const char* type) {
  const jobs::JobRow row = find_job(queue, caller, request);
  const bool complete = row.state == jobs::JobState::succeeded;
  const int run = requested_run(request, row);
  const fs::path root =
      complete
          ? folders.dataset_folder(row.id)
          : jobs::JobFolder(folders.job_folder(row.id)).output_of({jobs::Task::Kind::measure, run});
  const fs::path file = root / folder / (jobs::run_name(run) + suffix);
  if (exists_without_links(file)) return response.set_content(read_file(file), type);
  if (!complete && !fs::exists(root)) {
    throw HttpError{409, fmt::format("the job is {}; this is there once run {} was measured",
                                     to_string(row.state), run)};
  }
  throw HttpError{404, fmt::format("there is no {} of run {}", folder, run)};
}

jobs::ArchiveFormat requested_format(const Request& request) {
  const std::string format =
      request.has_param("format") ? request.get_param_value("format") : "tar";
  if (format == "tar") return jobs::ArchiveFormat::tar;
  if (format == "zip") return jobs::ArchiveFormat::zip;
  throw HttpError{400, "format is wrong", {{"", "?format", format, "tar or zip"}}};
}

/// Numbers of the runs of a split in dataset.json.
std::vector<int> runs_of_split(const fs::path& dataset, const std::string& split) {
  const fs::path card = dataset / "dataset.json";
  const json splits =
      fs::exists(card)
          ? parse_own_json(read_file(card), "dataset.json").value("splits", json::object())
          : json::object();
  if (!splits.contains(split)) {
    std::vector<std::string> names;
    for (const auto& [name, runs] : splits.items()) names.push_back(name);
    throw HttpError{400,
                    "split is wrong",
                    {{"", "?split", split, fmt::format("one of: {}", fmt::join(names, ", "))}}};
  }
  std::vector<int> numbers;
  for (const std::string run : splits.at(split)) {
    numbers.push_back(std::stoi(run.substr(std::string_view("run").size())));
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// Selection by ?include=, ?runs= and ?split=. Throws HttpError and InputError.
jobs::Selection requested_selection(const Request& request, const fs::path& dataset,
                                    const json& job) {
  jobs::Selection selection;
  std::istringstream names(request.get_param_value("include"));
  for (std::string name; std::getline(names, name, ',');) selection.include.push_back(name);
  if (request.has_param("runs") && request.has_param("split")) {
    throw HttpError{400, "runs are asked for by their numbers or by their split, not by both"};
  }
  if (request.has_param("runs")) {
    selection.runs =
        jobs::parse_runs(request.get_param_value("runs"), job.at("runs").get<int>(), "?runs");
  }
  if (request.has_param("split")) {
    selection.runs = runs_of_split(dataset, request.get_param_value("split"));
  }
  return selection;
}

/// Files below a folder that have a name of their own, by their path from there.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!exists_without_links(folder)) return files;
  std::error_code error;
  fs::recursive_directory_iterator entries(folder, error);
  for (; !error && entries != fs::recursive_directory_iterator(); entries.increment(error)) {
    if (entries->symlink_status(error).type() == fs::file_type::regular)
      files.push_back(entries->path().lexically_relative(folder));
  }
  return files;
}

/// Folders of a job's dataset files: the dataset, or the shards that have been published so far.
std::vector<fs::path> places_of_images(const fs::path& job) {
  if (exists_without_links(job / "dataset")) return {job / "dataset"};
  std::vector<fs::path> places;
  if (!exists_without_links(job / "work")) return places;
  std::error_code error;
  for (const auto& run : fs::directory_iterator(job / "work", error)) {
    if (run.is_symlink(error)) continue;
    for (const auto& shard : fs::directory_iterator(run.path(), error)) {
      const std::string name = shard.path().filename().string();
      if (name.starts_with("shard") && name.find('.') == std::string::npos) {
        places.push_back(jobs::published_file(shard.path(), ""));
      }
    }
  }
  return places;
}

/// An image with drawn annotations, and the same without.
struct Preview {
  std::string name;
  fs::path drawn;
  fs::path clean;
};

/// By their names.
std::vector<Preview> list_previews(const fs::path& job) {
  std::vector<Preview> previews;
  for (const fs::path& place : places_of_images(job)) {
    for (const fs::path& file : files_below(place / "previews")) {
      previews.push_back(
          {file.generic_string(), place / "previews" / file, place / "images" / file});
    }
  }
  std::sort(previews.begin(), previews.end(),
            [](const Preview& a, const Preview& b) { return a.name < b.name; });
  return previews;
}

}  // namespace

int requested_run(const Request& request, const jobs::JobRow& row) {
  const std::string number = request.matches[2];
  constexpr std::size_t kMaxDigits = 6;
  const int run = number.size() <= kMaxDigits ? std::stoi(number) : -1;
  if (run < 0 || run >= parse_own_json(row.spec_json, "the job").at("runs").get<int>()) {
    throw HttpError{404, fmt::format("the job has no run {}", number)};
  }
  return run;
}

void send_archive(JobQueue& queue, Datasets& datasets, const ServiceFolders& folders,
                  const Caller& caller, const Request& request, Response& response) {
  const jobs::JobRow row = find_succeeded(queue, folders, caller, request);
  const fs::path dataset = folders.dataset_folder(row.id);
  const std::string name = slug(row.name);
  const jobs::ArchiveFormat format = requested_format(request);
  const auto archive = datasets.archive_of(
      dataset, name, format,
      requested_selection(request, dataset, parse_own_json(row.spec_json, "the job")));
  if (archive->is_empty()) {
    throw HttpError{404, "the dataset has no file of those that were asked for"};
  }
  // The manifest holds the hash of every file; what was chosen of them is in the query.
  const std::string chosen =
      request.target.substr(std::min(request.target.find('?'), request.target.size()));
  const std::string manifest = datasets.manifest_of(dataset)->itself.sha256;
  const std::string etag =
      fmt::format("\"{}\"", chosen.empty() ? manifest : sha256_hex(manifest + chosen));
  if (is_current(request, response, etag)) return;
  settle_range(request, response, etag, archive->size());
  const bool zip = format == jobs::ArchiveFormat::zip;
  response.set_header("Content-Disposition",
                      fmt::format("attachment; filename=\"{}.{}\"", name, zip ? "zip" : "tar"));
  response.set_content_provider(
      static_cast<std::size_t>(archive->size()), zip ? "application/zip" : "application/x-tar",
      [archive, buffer = std::vector<char>(), id = row.id](std::size_t offset, std::size_t length,
                                                           httplib::DataSink& sink) mutable {
        constexpr std::size_t kBlock = 1 << 20;
        buffer.resize(std::min(length, kBlock));
        try {
          const std::size_t count = archive->read(static_cast<std::int64_t>(offset), buffer);
          return sink.write(buffer.data(), count);
        } catch (const EnvironmentError& error) {
          // The length has been promised: all that is left is to break off.
          spdlog::error("archive of job {}: {}", id, error.what());
          return false;
        }
      });
}

void send_manifest(JobQueue& queue, Datasets& datasets, const ServiceFolders& folders,
                   const Caller& caller, const Request& request, Response& response) {
  const fs::path dataset =
      folders.dataset_folder(find_succeeded(queue, folders, caller, request).id);
  answer_with_file(request, response, dataset / jobs::kManifestName, "application/json",
                   fmt::format("\"{}\"", datasets.manifest_of(dataset)->itself.sha256));
}

void send_file(JobQueue& queue, Datasets& datasets, const ServiceFolders& folders,
               const Caller& caller, const Request& request, Response& response) {
  const fs::path dataset =
      folders.dataset_folder(find_succeeded(queue, folders, caller, request).id);
  const std::string wanted = request.matches[2];
  const auto manifest = datasets.manifest_of(dataset);
  const std::vector<jobs::FileEntry>& files = manifest->files;
  // Files of the manifest are in the dataset: no path leads out of it.
  const auto file =
      std::lower_bound(files.begin(), files.end(), wanted,
                       [](const auto& entry, const auto& path) { return entry.path < path; });
  if (file == files.end() || file->path != wanted) {
    throw HttpError{404, "the dataset has no such file"};
  }
  answer_with_file(request, response, dataset / wanted, media_type(wanted),
                   fmt::format("\"{}\"", file->sha256));
}

void list_images_of_job(JobQueue& queue, Datasets& datasets, const ServiceFolders& folders,
                        const Caller& caller, const Request& request, Response& response) {
  constexpr std::int64_t kMaxOffset = 1'000'000'000;
  const fs::path dataset =
      folders.dataset_folder(find_succeeded(queue, folders, caller, request).id);
  const ImageQuery query{
      request.get_param_value("run"), request.get_param_value("camera"),
      requested_number(request, "offset", 0, kMaxOffset, 0),
      requested_number(request, "limit", 1, kMaxImagesOfPage, kUsualImagesOfPage)};
  const auto manifest = datasets.manifest_of(dataset);
  const ImageList list = list_images(manifest->files, query);
  json images = json::array();
  for (const ImageFile& image : list.images) {
    images.push_back({{"run", image.run},
                      {"camera", image.camera},
                      {"frame", image.frame},
                      {"path", image.file->path},
                      {"bytes", image.file->bytes}});
  }
  json runs = json::array();
  for (const auto& [run, cameras] : list.runs) {
    json parts = json::array();
    for (const auto& [camera, frames] : cameras) {
      parts.push_back({{"camera", camera},
                       {"images", frames.images},
                       {"first", frames.first},
                       {"last", frames.last}});
    }
    runs.push_back({{"run", run}, {"cameras", std::move(parts)}});
  }
  write_json(response, 200,
             {{"images", std::move(images)}, {"total", list.total}, {"runs", std::move(runs)}});
}

void send_metrics(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                  const Request& request, Response& response) {
  const fs::path dataset =
      folders.dataset_folder(find_succeeded(queue, folders, caller, request).id);
  response.set_content(read_file(dataset / "metrics.json"), "application/json");
}

void send_run_metrics(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                      const Request& request, Response& response) {
  send_run_file(queue, folders, caller, request, response, "metrics", ".json", "application/json");
}

fs::path trace_file(const ServiceFolders& folders, const jobs::JobRow& row, int run) {
  fs::path trace =
      jobs::JobFolder(folders.job_folder(row.id)).output_of({jobs::Task::Kind::simulate, run});
  if (exists_without_links(trace)) return trace;
  throw HttpError{409, fmt::format("the job is {}; this is there once run {} was simulated",
                                   to_string(row.state), run)};
}

void send_run_trace(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                    const Request& request, Response& response) {
  const jobs::JobRow row = find_job(queue, caller, request);
  const int run = requested_run(request, row);
  const fs::path trace = trace_file(folders, row, run);
  response.set_header("Content-Disposition", fmt::format("attachment; filename=\"{}_{}.h5\"",
                                                         slug(row.name), jobs::run_name(run)));
  answer_with_file(request, response, trace, "application/x-hdf5",
                   fmt::format("\"{}\"", jobs::sealed_hash(trace)));
}

void send_run_metrics_csv(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                          const Request& request, Response& response) {
  send_run_file(queue, folders, caller, request, response, "exits", ".csv", "text/csv");
}

void send_report(JobQueue& queue, ReportMaker& reports, const ServiceFolders& folders,
                 const Caller& caller, const Request& request, Response& response) {
  // Shorter than a proxy's patience, and than what is left to a service that ends.
  constexpr auto kPatience = std::chrono::seconds(5);
  const jobs::JobRow row = find_succeeded(queue, folders, caller, request);
  const std::optional<fs::path> file =
      reports.report_of(folders.job_folder(row.id),
                        {.owner = row.owner,
                         .job = row.id,
                         .priority = [priority = row.priority] { return priority; },
                         .memory_mib = [](const jobs::Task&) { return jobs::kReportMemoryMib; }},
                        kPatience);
  if (!file) {
    response.set_header("Retry-After", "2");
    return write_json(response, 202, {{"status", "the report is being made"}});
  }
  answer_with_file(request, response, *file, "text/html; charset=utf-8",
                   fmt::format("\"{}\"", sha256_hex_of_file(*file)));
}

void list_logs(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
               const Request& request, Response& response) {
  const jobs::JobRow row = find_job(queue, caller, request);
  const fs::path folder = folders.job_folder(row.id) / "logs";
  std::vector<fs::path> files = files_below(folder);
  std::sort(files.begin(), files.end());
  json logs = json::array();
  for (const fs::path& file : files) {
    std::error_code error;
    const auto bytes = fs::file_size(folder / file, error);
    if (error) continue;
    logs.push_back({{"name", file.string()},
                    {"bytes", bytes},
                    {"href", fmt::format("/v1/jobs/{}/logs/{}", row.id, file.string())}});
  }
  write_json(response, 200, {{"logs", std::move(logs)}});
}

void send_log(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
              const Request& request, Response& response) {
  const jobs::JobRow row = find_job(queue, caller, request);
  const std::string name = request.matches[2];
  const fs::path file = folders.job_folder(row.id) / "logs" / name;
  std::error_code ignored;  // e.g. the name is too long for a file
  if (name == ".." || !fs::is_regular_file(file, ignored) || !exists_without_links(file)) {
    throw HttpError{404, fmt::format("the job has no log {}", name)};
  }
  answer_with_growing_file(request, response, file, "text/plain; charset=utf-8");
}

std::string newest_preview(const fs::path& job_folder) {
  std::string newest;
  fs::file_time_type written;
  for (const Preview& preview : list_previews(job_folder)) {
    std::error_code error;
    const auto time = fs::last_write_time(preview.drawn, error);
    if (error || (!newest.empty() && time <= written)) continue;
    newest = preview.name;
    written = time;
  }
  return newest;
}

void list_previews(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                   const Request& request, Response& response) {
  const jobs::JobRow row = find_job(queue, caller, request);
  json previews = json::array();
  for (const Preview& preview : list_previews(folders.job_folder(row.id))) {
    const std::string href = fmt::format("/v1/jobs/{}/previews/{}", row.id, preview.name);
    previews.push_back({{"name", preview.name}, {"href", href}, {"clean", href + "?clean"}});
  }
  write_json(response, 200, {{"previews", std::move(previews)}});
}

void send_preview(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                  const Request& request, Response& response) {
  const jobs::JobRow row = find_job(queue, caller, request);
  const std::string wanted = request.matches[2];
  const bool clean = is_asked(request, "clean");
  for (const Preview& preview : list_previews(folders.job_folder(row.id))) {
    if (preview.name != wanted) continue;
    const fs::path& file = clean ? preview.clean : preview.drawn;
    return answer_with_growing_file(request, response, file, media_type(file));
  }
  throw HttpError{404, "there is no such preview (yet)"};
}

}  // namespace throng::server
