// throng validate: does a dataset keep what its formats promise?
#include "checks/validate.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/text/words.h"
#include "cli/more/more_commands.h"
#include "cli/shell/input_file.h"

namespace throng::cli {

namespace {

void validate(const std::string& dataset) {
  check_input_file(dataset, "the folder of a finished dataset");
  if (!std::filesystem::is_directory(dataset)) {
    throw InputError(
        {dataset, "", "a file", "the folder of a finished dataset; an archive is unpacked first"});
  }
  const checks::Validation validation = checks::validate_dataset(dataset);
  for (const checks::Finding& finding : validation.findings) {
    fmt::print("{}: {}{}{} [{}]\n", finding.file, finding.record,
               finding.record.empty() ? "" : ": ", finding.what, finding.rule);
  }
  if (validation.found > validation.findings.size()) {
    fmt::print("... and {} more\n", validation.found - validation.findings.size());
  }
  if (validation.found > 0) {
    throw InputError(
        {dataset, "", counted(static_cast<std::int64_t>(validation.found), "fault"), "none"});
  }
  fmt::print("{}: {} with {}, no faults\n", dataset,
             counted(static_cast<std::int64_t>(validation.images), "image"),
             counted(static_cast<std::int64_t>(validation.annotations), "annotation"));
}

}  // namespace

void add_validate(CLI::App& app) {
  auto* command = app.add_subcommand(
      "validate",
      "Check the consistency of a dataset; exit code 2 and a list of errors if it fails");
  const auto dataset = std::make_shared<std::string>();
  command->add_option("dataset", *dataset, "Folder of the dataset")->required();
  command->callback([dataset] { validate(*dataset); });
}

}  // namespace throng::cli
