// throng validate-crowd: standard tests of the pedestrian models.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "base/files/files.h"
#include "cli/shell/commands.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "crowd/validation/suite.h"

namespace throng::cli {

namespace {

struct ValidateCrowdArguments {
  std::vector<std::string> models;
  std::vector<std::string> tests;
  std::string output;
  int threads = 0;
  bool reduced = false;
};

void validate_crowd(const ValidateCrowdArguments& arguments) {
  validation::Results results;
  {
    const Interrupt interrupt;
    ProgressBar bar("validation");
    results = validation::run_suite(
        arguments.models, arguments.tests,
        arguments.reduced ? validation::Effort::reduced : validation::Effort::full,
        arguments.threads,
        [&](std::size_t done, std::size_t total) {
          bar.show(static_cast<double>(done) / static_cast<double>(total),
                   fmt::format("{} of {} tests", done, total));
        },
        interrupt.token());
  }
  const std::string page = validation::markdown(results);
  if (arguments.output.empty()) {
    fmt::print("{}", page);
  } else {
    write_file_atomically(arguments.output, page);
  }
}

}  // namespace

void add_validate_crowd(CLI::App& app) {
  auto* command = app.add_subcommand(
      "validate-crowd",
      "Run the RiMEA and NIST verification tests of pedestrian models (docs/validation.md)");
  const auto arguments = std::make_shared<ValidateCrowdArguments>();
  command->add_option("-m,--models", arguments->models, "Only these models (a,b,...)")
      ->delimiter(',');
  command->add_option("--tests", arguments->tests, "Only these tests (rimea_1,nist_2_8,...)")
      ->delimiter(',');
  command->add_flag("--reduced", arguments->reduced, "Fewer people and runs: seconds per model");
  command->add_option("-j,--threads", arguments->threads, "Parallel tests (0: one per core)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output,
                      "File (Markdown) to write instead of standard output");
  command->callback([arguments] { validate_crowd(*arguments); });
}

}  // namespace throng::cli
