#include "validation/experiments/experiment.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "base/files/files.h"
#include "validation/experiments/archive.h"

namespace throng::validation {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFileName = "experiments.json";

bool is_described(const std::vector<Experiment>& described, const fs::path& file) {
  const auto is_same = [&](const fs::path& other) {
    std::error_code ignored;
    return fs::equivalent(other, file, ignored);
  };
  return std::any_of(described.begin(), described.end(), [&](const Experiment& experiment) {
    return (experiment.recording && is_same(experiment.recording->file)) ||
           (experiment.single_file && is_same(experiment.single_file->file));
  });
}

bool is_hermes(const std::string& name) {
  return name.starts_with("uo-") || name.starts_with("UO-");
}

std::vector<fs::path> files_in(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw InputError(
        {"", "", fmt::format("{} {}", fs::exists(folder) ? "a file" : "no folder", folder.string()),
         "a folder of recorded experiments"});
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<Experiment> find_experiments(const fs::path& folder) {
  const std::vector<fs::path> files = files_in(folder);
  const fs::path description = folder / kFileName;
  std::vector<Experiment> experiments;
  if (fs::exists(description)) experiments = parse_experiments(read_file(description), folder);
  const std::vector<Experiment> described = experiments;
  bool hermes = false;
  for (const fs::path& file : files) {
    std::optional<Experiment> known = archived_experiment(file);
    if (!known || is_described(described, file)) continue;
    hermes = hermes || is_hermes(known->name);
    experiments.push_back(std::move(*known));
  }
  if (hermes) experiments.push_back(hermes_diagram());
  if (experiments.empty()) {
    throw InputError({folder.string(), "", "no experiment",
                      fmt::format("{}, or files with names of the Pedestrian Dynamics Data Archive "
                                  "(docs/validation.md)",
                                  kFileName)});
  }
  const auto by_name = [](const Experiment& a, const Experiment& b) { return a.name < b.name; };
  std::stable_sort(experiments.begin(), experiments.end(), by_name);
  const auto twice =
      std::adjacent_find(experiments.begin(), experiments.end(),
                         [](const Experiment& a, const Experiment& b) { return a.name == b.name; });
  if (twice != experiments.end()) {
    throw InputError({folder.string(), "", fmt::format("two experiments \"{}\"", twice->name),
                      "one of each name; is a file there both compressed and not?"});
  }
  return experiments;
}

std::vector<std::string> unread_files(const fs::path& folder,
                                      const std::vector<Experiment>& experiments) {
  std::vector<std::string> names;
  for (const fs::path& file : files_in(folder)) {
    if (file.filename() != kFileName && !is_described(experiments, file)) {
      names.push_back(file.filename().string());
    }
  }
  return names;
}

}  // namespace throng::validation
