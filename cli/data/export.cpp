// throng export: a finished dataset in other formats.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "cli/shell/commands.h"
#include "formats/export/exporter.h"

namespace throng::cli {

namespace fs = std::filesystem;

namespace {

struct ExportArguments {
  std::string dataset;
  std::string output;
  std::vector<std::string> formats;
  std::vector<std::string> splits;
  std::optional<double> min_visibility;
  std::optional<double> min_height_px;
  std::optional<double> max_truncation;
  std::optional<double> min_contrast;
  std::optional<double> shard_mb;
  std::optional<std::string> classes;
  std::vector<std::string> class_names;
};

/// "left=right" as its two sides.
std::pair<std::string, std::string> split_assignment(const std::string& text,
                                                     const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError({"", option, text, "NAME=VALUE"});
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// train=0.8, val=0.2 or val=run003: shares or runs.
formats::SplitOptions read_splits(const std::vector<std::string>& words) {
  formats::SplitOptions splits;
  bool has_train = false;
  for (const std::string& word : words) {
    const auto [name, value] = split_assignment(word, "--split");
    const auto found = std::find(formats::kSplitNames.begin(), formats::kSplitNames.end(), name);
    if (found == formats::kSplitNames.end()) {
      throw InputError({"", "--split", name, "train, val or test"});
    }
    const auto index = static_cast<std::size_t>(found - formats::kSplitNames.begin());
    if (value.starts_with("run")) {
      splits.runs[value] = static_cast<formats::Split>(index);
      continue;
    }
    has_train = has_train || index == static_cast<std::size_t>(formats::Split::train);
    char* end = nullptr;
    splits.share[index] = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != '\0' || !(splits.share[index] >= 0 && splits.share[index] <= 1)) {
      throw InputError(
          {"", "--split " + name, value, "a share from 0 to 1, or a run such as run003"});
    }
  }
  std::vector<Problem> problems;
  formats::settle_shares(has_train, "--split", splits, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return splits;
}

/// The options of the dataset's job, as long as the arguments do not say otherwise.
formats::ExportOptions read_options(const ExportArguments& arguments,
                                    const nlohmann::json& manifest) {
  formats::ExportOptions options = formats::export_options(arguments.dataset, manifest);
  if (!arguments.splits.empty()) options.splits = read_splits(arguments.splits);
  formats::FilterOptions& filters = options.filters;
  filters.min_visibility = arguments.min_visibility.value_or(filters.min_visibility);
  filters.min_height_px = arguments.min_height_px.value_or(filters.min_height_px);
  if (arguments.max_truncation) filters.max_truncation = arguments.max_truncation;
  filters.min_contrast = arguments.min_contrast.value_or(filters.min_contrast);
  options.webdataset.shard_mb = arguments.shard_mb.value_or(options.webdataset.shard_mb);
  if (arguments.classes) options.classes = {*arguments.classes, {}};
  for (const std::string& word : arguments.class_names) {
    formats::add_class_name(word, "--class-name", options.classes);
  }
  return options;
}

void check_named_runs(const formats::DatasetInfo& info) {
  for (const auto& [run, split] : info.options.splits.runs) {
    if (std::find(info.runs.begin(), info.runs.end(), run) != info.runs.end()) continue;
    throw InputError({"", fmt::format("--split {}", to_string(split)), run,
                      fmt::format("one of: {}", fmt::join(info.runs, ", "))});
  }
}

/// "train run000, run002; val run001"
std::string list_splits(const formats::DatasetInfo& info) {
  std::vector<std::string> parts;
  for (const formats::Split split : info.splits()) {
    std::vector<std::string> runs;
    for (const std::string& run : info.runs) {
      if (info.split_of(run) == split) runs.push_back(run);
    }
    constexpr std::size_t kMaxNames = 8;
    parts.push_back(runs.size() > kMaxNames
                        ? fmt::format("{} {} runs", to_string(split), runs.size())
                        : fmt::format("{} {}", to_string(split), fmt::join(runs, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// Recordings are complete up to the time at which the disk was full: they stay in OUTPUT.partial,
/// which a new error says.
void keep_recordings(const fs::path& staged, const std::string& output,
                     const EnvironmentError& error) {
  const fs::path kept = output + ".partial";
  std::error_code failed;
  if (!fs::exists(staged / "mcap", failed) || fs::exists(kept, failed)) return;
  fs::rename(staged / "mcap", kept, failed);
  if (failed) return;
  throw EnvironmentError(
      fmt::format("{}; recordings until then are in {}", error.what(), kept.string()));
}

void export_formats(const ExportArguments& arguments) {
  const fs::path root = arguments.dataset;
  const nlohmann::json manifest = formats::read_manifest(root);
  const formats::DatasetInfo info =
      formats::describe_dataset(root, manifest, read_options(arguments, manifest));
  if (!arguments.splits.empty()) check_named_runs(info);
  if (info.options.filters.min_contrast > 0 && !info.has(annotate::GroundTruth::difficulty)) {
    throw InputError({"", "--min-contrast", "a dataset without the annotation difficulty",
                      "one whose job has \"difficulty\" in outputs.annotations"});
  }
  const auto chosen = formats::choose_formats(arguments.formats, info.annotations, "--formats");
  if (fs::exists(arguments.output)) {
    throw InputError({"", "--output", arguments.output + ", which exists", "a new folder"});
  }
  StagingFolder staging(arguments.output);
  std::vector<Problem> warnings = formats::split_warnings(info, chosen);
  try {
    for (Problem& warning : formats::export_dataset(info, chosen, staging.path())) {
      warnings.push_back(std::move(warning));
    }
  } catch (const EnvironmentError& error) {
    keep_recordings(staging.path(), arguments.output, error);
    throw;
  }
  staging.commit();
  for (const Problem& warning : warnings) {
    fmt::print(stderr, "throng: warning: {}\n", warning.text());
  }
  if (info.splits().size() > 1) fmt::print(stderr, "throng: splits: {}\n", list_splits(info));
  for (const formats::Format* format : chosen) {
    fmt::print("{}\n", (fs::path(arguments.output) / format->name).string());
  }
}

/// The limits beyond which a person becomes an ignore region.
void add_filter_options(CLI::App& command, ExportArguments& arguments) {
  command
      .add_option("--min-visibility", arguments.min_visibility,
                  "People less visible than this become ignore regions")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--max-truncation", arguments.max_truncation,
                  "People farther outside of the image become ignore regions")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--min-contrast", arguments.min_contrast,
                  "People whose color differs less than this (CIELAB) from the surroundings become "
                  "ignore regions; needs the annotation difficulty")
      ->check(CLI::Range(0.0, 100.0));
  command
      .add_option("--min-height", arguments.min_height_px,
                  "People smaller than this height in pixels become ignore regions")
      ->check(CLI::Range(0.0, 1e6));
}

void list_formats() {
  for (const formats::Format& format : formats::all_formats()) {
    fmt::print("{:<26}{}\n", format.name, format.summary);
  }
}

/// CLI11 would also require them with --list.
void check_required(const ExportArguments& arguments) {
  for (const auto& [name, is_missing] : {std::pair{"DATASET", arguments.dataset.empty()},
                                         {"--output", arguments.output.empty()},
                                         {"--formats", arguments.formats.empty()}}) {
    if (is_missing) {
      throw InputError(
          {"throng export", "", fmt::format("missing {} (`throng export --help`)", name), ""});
    }
  }
}

}  // namespace

void add_export(CLI::App& app) {
  auto* command = app.add_subcommand("export", "Write a finished dataset in other formats");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("dataset", arguments->dataset, "Folder of the dataset");
  command->add_option("-o,--output", arguments->output, "Output folder, which must not exist");
  command->add_option("--formats", arguments->formats, "Formats, separated by commas (see --list)")
      ->delimiter(',');
  command
      ->add_option(
          "--split", arguments->splits,
          "Instead of the dataset's splits: shares of the runs or runs, train=0.8,val=0.2 or "
          "test=run003; without train it gets the remaining runs")
      ->delimiter(',');
  add_filter_options(*command, *arguments);
  command
      ->add_option("--shard-mb", arguments->shard_mb, "Size of WebDataset's tar files (10^6 bytes)")
      ->check(CLI::Range(1.0, 1e5));
  command->add_option("--classes", arguments->classes, "Attribute that defines the classes")
      ->check(CLI::IsMember([] {
        std::vector<std::string> names;
        for (const std::string_view name : formats::class_properties()) names.emplace_back(name);
        return names;
      }()));
  command
      ->add_option("--class-name", arguments->class_names,
                   "Another name for a value: female=woman,male=man")
      ->delimiter(',');
  const auto list = std::make_shared<bool>(false);
  command->add_flag("--list", *list, "List the formats and exit");
  command->callback([arguments, list] {
    if (*list) {
      list_formats();
    } else {
      check_required(*arguments);
      export_formats(*arguments);
    }
  });
}

}  // namespace throng::cli
