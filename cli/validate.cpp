// throng validate: does a dataset keep what its formats promise?
#include "formats/validate.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "base/error.h"
#include "cli/commands.h"

namespace throng::cli {

namespace {

void validate(const std::string& dataset) {
  const formats::Validation validation = formats::validate_dataset(dataset);
  for (const formats::Finding& finding : validation.findings) {
    fmt::print("{}: {}{}{} [{}]\n", finding.file, finding.record,
               finding.record.empty() ? "" : ": ", finding.what, finding.rule);
  }
  if (validation.found > validation.findings.size()) {
    fmt::print("... and {} more\n", validation.found - validation.findings.size());
  }
  if (validation.found > 0) {
    throw InputError({dataset, "", fmt::format("{} faults", validation.found), "none"});
  }
  fmt::print("{}: {} images with {} annotations, no faults\n", dataset, validation.images,
             validation.annotations);
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
