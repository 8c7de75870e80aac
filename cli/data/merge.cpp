// throng merge: several datasets as one.
#include "formats/merge.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/text/words.h"
#include "cli/shell/commands.h"

namespace throng::cli {

namespace {

struct MergeArguments {
  std::vector<std::string> datasets;
  std::string output;
};

void merge(const MergeArguments& arguments) {
  if (arguments.datasets.size() < 2) {
    throw InputError({"throng merge", "", counted(1, "dataset"), "two or more"});
  }
  const formats::MergedCounts merged = formats::merge_datasets(
      {arguments.datasets.begin(), arguments.datasets.end()}, arguments.output);
  fmt::print("{}: {} of {} with {}\n", arguments.output, counted(merged.images, "image"),
             counted(merged.runs, "run"), counted(merged.annotations, "annotation"));
}

}  // namespace

void add_merge(CLI::App& app) {
  auto* command = app.add_subcommand(
      "merge", "Make one dataset of several, with runs and ids counted on (docs/formats.md)");
  const auto arguments = std::make_shared<MergeArguments>();
  command->add_option("datasets", arguments->datasets, "Folders of finished datasets")->required();
  command->add_option("-o,--output", arguments->output, "Folder of the new dataset")->required();
  command->callback([arguments] { merge(*arguments); });
}

}  // namespace throng::cli
