#include "formats/merge.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "annotate/people/coco.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/json/json_describe.h"
#include "base/json/json_text.h"
#include "base/schemas/json_schema.h"
#include "base/version.h"
#include "formats/card.h"
#include "formats/dataset/dataset.h"
#include "formats/dataset/output.h"
#include "formats/export/exporter.h"
#include "formats/merged_ids.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int kJsonIndent = 2;

std::string run_name(std::size_t run) { return fmt::format("run{:03}", run); }

/// A dataset that becomes a part of another one.
struct Part {
  fs::path root;
  json manifest;
  std::size_t first_run = 0;            ///< number of its first run in the result
  std::vector<std::string> runs;        ///< names as they are
  std::map<std::string, Split> splits;  ///< of the runs, by their names in the result

  std::string new_name(const std::string& run) const {
    const auto at = std::find(runs.begin(), runs.end(), run);
    return at == runs.end() ? run
                            : run_name(first_run + static_cast<std::size_t>(at - runs.begin()));
  }
};

/// Fields of the job that the whole dataset is read by.
constexpr std::array kEqualFields = {"/capture",         "/outputs/annotations", "/outputs/classes",
                                     "/outputs/density", "/outputs/fields",      "/outputs/counts",
                                     "/outputs/filters", "/outputs/image"};

json value_at(const json& document, const char* pointer) {
  const json::json_pointer place(pointer);
  return document.contains(place) ? document.at(place) : json(nullptr);
}

json list_ids(const json& drones) {
  json ids = json::array();
  for (const json& drone : drones) ids.push_back(drone.value("id", json()));
  return ids;
}

/// The fields that two jobs have in common; null where they differ.
json in_common(const json& a, const json& b) {
  if (a == b) return a;
  if (a.is_object() && b.is_object()) {
    json common = json::object();
    for (const auto& [key, value] : a.items()) {
      if (!b.contains(key)) continue;
      json same = in_common(value, b.at(key));
      if (!same.is_null()) common[key] = std::move(same);
    }
    return common;
  }
  if (!a.is_array() || !b.is_array() || a.size() != b.size()) return nullptr;
  json common = json::array();
  for (std::size_t i = 0; i < a.size(); ++i) {
    common.push_back(in_common(a[i], b[i]));
    if (common.back().is_null()) return nullptr;
  }
  return common;
}

void require_alike(const Part& first, const Part& other) {
  const json& a = first.manifest.at("job");
  const json& b = other.manifest.at("job");
  std::vector<Problem> problems;
  const std::string file = (other.root / "manifest.json").string();
  const auto compare = [&](const std::string& pointer, const json& wanted, const json& found) {
    if (wanted == found) return;
    problems.push_back({file, pointer, describe(found),
                        fmt::format("{}, as in {}", describe(wanted), first.root.string())});
  };
  for (const char* field : kEqualFields) {
    compare(fmt::format("/job{}", field), value_at(a, field), value_at(b, field));
  }
  compare("/job/drones", list_ids(a.value("drones", json::array())),
          list_ids(b.value("drones", json::array())));
  compare("/people", value_at(first.manifest, "/people"), value_at(other.manifest, "/people"));
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// The fields of a manifest that the merged dataset needs.
const schemas::JsonSchema& manifest_schema() {
  static const schemas::JsonSchema schema(parse_json(R"({
    "type": "object",
    "required": ["schema_version", "job", "devices", "people", "counts", "runs", "files"],
    "properties": {
      "job": {"type": "object", "required": ["name", "outputs"], "properties": {
        "name": {"type": "string"}, "outputs": {"type": "object"}}},
      "devices": {"type": "array", "items": {"type": "string"}},
      "counts": {"type": "object", "required": ["frames", "annotations"], "properties": {
        "frames": {"type": "integer", "minimum": 0, "maximum": 1000000000},
        "annotations": {"type": "integer", "minimum": 0, "maximum": 1000000000000},
        "agents": {"type": "integer", "minimum": 0, "maximum": 1000000000}}},
      "people": {"type": "object"},
      "schema_version": {"type": "integer"},
      "runs": {"type": "array", "minItems": 1, "items": {
        "type": "object", "required": ["run"], "properties": {
          "run": {"type": "string"}, "scenario": {"type": "string"}}}},
      "files": {"type": "array", "items": {
        "type": "object", "required": ["path", "sha256"], "properties": {
          "path": {"type": "string", "minLength": 1}, "sha256": {"type": "string"}}}}}})",
                                                     "manifest"));
  return schema;
}

Part read_part(const fs::path& root, std::size_t first_run) {
  if (!fs::is_directory(root)) {
    throw InputError({root.string(), "", fs::exists(root) ? "a file" : "no such folder",
                      "the folder of a finished dataset"});
  }
  Part part{root, read_manifest(root), first_run, {}, {}};
  const auto problems =
      manifest_schema().problems(part.manifest, (root / "manifest.json").string());
  if (!problems.empty()) throw InputError(problems);
  try {
    for (const json& run : part.manifest.at("runs")) part.runs.push_back(run.at("run"));
    const DatasetInfo info =
        describe_dataset(root, part.manifest, export_options(root, part.manifest));
    check_images_have_labels(info);
    for (const std::string& run : part.runs) {
      part.splits[part.new_name(run)] = info.split_of(run);
    }
  } catch (const json::exception& error) {
    throw bad_manifest(root, error);
  }
  return part;
}

/// The ids of scenarios that a job names.
std::string scenario_name(const Part& part, const json& run) {
  const json scenario = part.manifest.at("job").value("scenario", json());
  return run.value("scenario", scenario.is_string() ? scenario.get<std::string>() : "");
}

class Merger {
 public:
  Merger(std::vector<Part> parts, const fs::path& output)
      : parts_(std::move(parts)), staging_(output) {}

  MergedCounts merge() {
    for (const Part& part : parts_) take_files(part);
    write_metrics();
    json manifest = merged_manifest();
    const bool has_images = fs::exists(parts_.front().root / kCocoFile);
    if (has_images) write_coco(manifest);
    add_card(manifest);
    std::sort(files_.begin(), files_.end(),
              [](const json& a, const json& b) { return a.at("path") < b.at("path"); });
    const json& total = manifest.at("counts");
    const MergedCounts counts{static_cast<std::int64_t>(manifest.at("runs").size()),
                              total.at("frames"), total.at("annotations")};
    manifest["files"] = files_;
    write_temporary_file(staging_.path() / "manifest.json", manifest.dump(kJsonIndent) + "\n");
    staging_.commit();
    return counts;
  }

 private:
  /// The path in the result; "" of files that are made again, and of other formats.
  static std::string new_path(const Part& part, const fs::path& path) {
    constexpr std::array kMadeAgain = {"README.md", "dataset.json", "metrics.json", kCocoFile};
    const std::string text = path.generic_string();
    if (std::find(kMadeAgain.begin(), kMadeAgain.end(), text) != kMadeAgain.end()) return "";
    if (text.starts_with("formats/")) return "";
    fs::path renamed;
    for (const fs::path& step : path) {
      const bool is_run = step.extension().empty();
      renamed /= is_run ? part.new_name(step.string())
                        : part.new_name(step.stem().string()) + step.extension().string();
    }
    return renamed.generic_string();
  }

  void take_files(const Part& part) {
    for (json entry : part.manifest.at("files")) {
      const fs::path path = entry.at("path").get<std::string>();
      const std::string renamed = new_path(part, path);
      if (renamed.empty()) continue;
      const fs::path source = part.root / path;
      if (!fs::is_regular_file(source)) {
        throw InputError({source.string(), "", "no such file", "a file of the manifest"});
      }
      if (hashes_of_file(source).sha256_hex != entry.at("sha256")) {
        throw InputError({source.string(), "", "a file whose SHA-256 is not that of manifest.json",
                          "the file as it was written (`throng validate`)"});
      }
      const std::string stem = path.stem().string();
      const auto at = std::find(part.runs.begin(), part.runs.end(), stem);
      const std::optional<std::string> shifted =
          at == part.runs.end()
              ? std::nullopt
              : with_shifted_tracks(source, path.begin()->string(), track_shift(part));
      if (shifted) {
        add(renamed, *shifted);
        continue;
      }
      link_or_copy(source, staging_.path() / renamed);
      entry["path"] = renamed;
      files_.push_back(std::move(entry));
    }
  }

  /// Track ids are by the number of the run among those of its dataset.
  static std::int64_t track_shift(const Part& part) {
    return static_cast<std::int64_t>(part.first_run) * annotate::kTrackIdsPerRun;
  }

  void write_metrics() {
    json runs = json::array();
    for (const Part& part : parts_) {
      const fs::path file = part.root / "metrics.json";
      json metrics = parse_json(read_file(file), file.string(), kOwnJsonLimits);
      if (!metrics.is_object() || !metrics.contains("runs") || !metrics["runs"].is_array()) {
        throw InputError({file.string(), "/runs", "no list", "the metrics that throng wrote"});
      }
      for (json& run : metrics["runs"]) {
        if (!run.is_object() || !run.contains("run") || !run["run"].is_string()) {
          throw InputError({file.string(), "/runs", describe(run), "a run with its name"});
        }
        run["run"] = part.new_name(run["run"]);
        runs.push_back(std::move(run));
      }
    }
    add("metrics.json", json{{"runs", std::move(runs)}}.dump(kJsonIndent) + "\n");
  }

  void write_coco(json& manifest) {
    std::vector<CocoPart> parts;
    for (const Part& part : parts_) {
      parts.push_back({part.root / kCocoFile, track_shift(part),
                       [&part](const std::string& run) { return part.new_name(run); }});
    }
    fs::create_directories((staging_.path() / kCocoFile).parent_path());
    join_coco_files(parts, manifest.at("job").at("name"), staging_.path() / kCocoFile);
    list(kCocoFile);
  }

  json merged_job() const {
    json job = parts_.front().manifest.at("job");
    std::vector<std::string> scenarios;
    std::size_t runs = 0;
    for (const Part& part : parts_) {
      job = in_common(job, part.manifest.at("job"));
      runs += part.runs.size();
      for (const json& run : part.manifest.at("runs")) {
        const std::string id = scenario_name(part, run);
        if (std::find(scenarios.begin(), scenarios.end(), id) == scenarios.end()) {
          scenarios.push_back(id);
        }
      }
    }
    job["runs"] = runs;
    if (!job.contains("name")) job["name"] = parts_.front().manifest.at("job").at("name");
    job["scenario"] = scenarios.size() == 1 ? json(scenarios.front()) : json(scenarios);
    json splits = json::object();
    for (const Part& part : parts_) {
      std::size_t run = part.first_run;
      for (const std::string& name : part.runs) {
        const Split split = part.splits.at(part.new_name(name));
        splits[fmt::format("{}_runs", to_string(split))].push_back(run++);
      }
    }
    job["outputs"]["splits"] = std::move(splits);
    job["outputs"]["formats"] = json::array();
    return job;
  }

  json merged_manifest() const {
    json runs = json::array();
    json counts = {{"frames", 0}, {"annotations", 0}, {"agents", 0}};
    std::set<std::string> devices;
    const json job = merged_job();
    for (const Part& part : parts_) {
      for (json run : part.manifest.at("runs")) {
        if (job.at("scenario").is_array()) run["scenario"] = scenario_name(part, run);
        run["run"] = part.new_name(run.at("run"));
        runs.push_back(std::move(run));
      }
      for (auto& [name, count] : counts.items()) {
        count = count.get<std::int64_t>() + part.manifest.at("counts").value(name, std::int64_t{0});
      }
      devices.merge(part.manifest.at("devices").get<std::set<std::string>>());
    }
    return {{"schema_version", parts_.front().manifest.at("schema_version")},
            {"generator", kGenerator},
            {"job", job},
            {"devices", devices},
            {"people", parts_.front().manifest.at("people")},
            {"counts", std::move(counts)},
            {"runs", std::move(runs)},
            {"failed_runs", json::array()}};
  }

  void add_card(const json& manifest) {
    if (!fs::exists(staging_.path() / kCocoFile)) return;
    const DatasetInfo info =
        describe_dataset(staging_.path(), manifest, export_options(staging_.path(), manifest));
    DatasetCard card(info, manifest, Output(staging_.path()));
    export_dataset(info, {}, staging_.path() / "formats", &card);
    for (const char* path : {"dataset.json", "README.md"}) list(path);
  }

  void add(const std::string& path, const std::string& bytes) {
    fs::create_directories((staging_.path() / path).parent_path());
    write_temporary_file(staging_.path() / path, bytes);
    list(path);
  }

  void list(const std::string& path) {
    const fs::path file = staging_.path() / path;
    const FileHashes hashes = hashes_of_file(file);
    files_.push_back({{"path", path},
                      {"bytes", fs::file_size(file)},
                      {"sha256", hashes.sha256_hex},
                      {"crc32", fmt::format("{:08x}", hashes.crc32)}});
  }

  std::vector<Part> parts_;
  StagingFolder staging_;
  std::vector<json> files_;
};

}  // namespace

MergedCounts merge_datasets(const std::vector<fs::path>& datasets, const fs::path& output) {
  if (fs::exists(output)) {
    throw InputError({output.string(), "", "something that is there already", "a new folder"});
  }
  std::vector<Part> parts;
  std::size_t runs = 0;
  for (const fs::path& dataset : datasets) {
    parts.push_back(read_part(dataset, runs));
    runs += parts.back().runs.size();
    require_alike(parts.front(), parts.back());
  }
  constexpr std::size_t kMaxRuns = 1000;  // as a job may have; names have three digits
  if (runs > kMaxRuns) {
    throw InputError({output.string(), "", fmt::format("{} runs", runs),
                      fmt::format("at most {} runs in a dataset", kMaxRuns)});
  }
  return Merger(std::move(parts), output).merge();
}

}  // namespace throng::formats
