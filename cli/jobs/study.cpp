// throng study: many paired runs of cases and policies, compared.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/shell/commands.h"
#include "cli/shell/document_kind.h"
#include "cli/shell/input_file.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "jobs/study/report.h"
#include "world/scenario.h"

namespace throng::cli {

namespace {

struct StudyArguments {
  std::string file;
  std::string output;
  int threads = 0;
  int runs = 0;
};

void run_study(const StudyArguments& arguments) {
  require_kind(DocumentKind::study, read_input_file(arguments.file, "a study file"),
               arguments.file);
  study::Study study = study::load_study(arguments.file, world::scenarios_folder());
  if (arguments.runs > 0) study.runs = std::min(arguments.runs, study.runs);
  study::Outcomes outcomes;
  {
    const Interrupt interrupt;
    ProgressBar bar(study.name);
    outcomes = study::do_runs(
        study, arguments.output, arguments.threads,
        [&](std::size_t done, std::size_t total) {
          bar.show(static_cast<double>(done) / static_cast<double>(total),
                   fmt::format("{} of {} runs", done, total));
        },
        interrupt.token());
  }
  study::write_report(study, outcomes, arguments.output);
  const auto warnings = study::case_warnings(study, outcomes, study::summarize(study, outcomes));
  for (std::size_t c = 0; c < warnings.size(); ++c) {
    for (const std::string& warning : warnings[c]) {
      fmt::print(stderr, "throng: warning: {}: {}\n", study.cases[c].title, warning);
    }
  }
  fmt::print("{}/summary.md\n", arguments.output);
}

}  // namespace

void add_study(CLI::App& app) {
  auto* command = app.add_subcommand(
      "study", "Compare guidance policies over many simulations, without rendering");
  const auto arguments = std::make_shared<StudyArguments>();
  command->add_option("study", arguments->file, "Study file (JSON; see docs/study.md)")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for results and report; an interrupted study is resumed")
      ->required();
  command->add_option("-j,--threads", arguments->threads, "Parallel runs (0: one per core)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--runs", arguments->runs, "Limit the number of seeds per case (default: all)")
      ->check(CLI::PositiveNumber);
  command->callback([arguments] { run_study(*arguments); });
}

}  // namespace throng::cli
