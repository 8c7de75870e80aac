// throng validate-crowd: standard tests of the pedestrian models, and comparisons with recorded
// people.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/drawing/drawing.h"
#include "base/text/suggest.h"
#include "cli/crowd/crowd_options.h"
#include "cli/more/more_commands.h"
#include "cli/shell/file_kind.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "crowd/project/project.h"
#include "validation/experiments/plots.h"
#include "validation/experiments/report.h"
#include "validation/suite.h"

namespace throng::cli {

namespace fs = std::filesystem;

namespace {

struct ValidateCrowdArguments {
  std::vector<std::string> models;
  std::vector<std::string> tests;
  std::string data;
  std::vector<std::string> experiments;
  std::optional<std::size_t> seeds;
  std::string constants;
  std::string output;
  int threads = 0;
  bool reduced = false;
  bool as_json = false;
};

std::vector<validation::Experiment> read_experiments(const ValidateCrowdArguments& arguments) {
  std::vector<validation::Experiment> all = validation::find_experiments(arguments.data);
  for (const std::string& name : validation::unread_files(arguments.data, all)) {
    fmt::print(stderr,
               "warning: {}: not read, since experiments.json does not describe it and its "
               "name is none of the archive's (docs/validation.md)\n",
               name);
  }
  if (arguments.experiments.empty()) return all;
  std::vector<std::string_view> names;
  names.reserve(all.size());
  for (const validation::Experiment& experiment : all) names.emplace_back(experiment.name);
  std::vector<validation::Experiment> chosen;
  for (const std::string& name : arguments.experiments) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw InputError(unknown_name("", "--experiments", "experiment", name, names));
    }
    chosen.push_back(all[static_cast<std::size_t>(found - names.begin())]);
  }
  return chosen;
}

std::vector<validation::Tested> tested_models(const ValidateCrowdArguments& arguments) {
  return validation::chosen_models(
      arguments.models, arguments.constants.empty() ? crowd::ConstantsChoice::best
                                                    : crowd::parse_constants(arguments.constants));
}

validation::Comparison compare_with_people(const ValidateCrowdArguments& arguments) {
  constexpr std::size_t kSeeds = 20;
  constexpr std::size_t kReducedSeeds = 2;
  const Interrupt interrupt;
  ProgressBar bar("validation");
  return validation::compare(
      read_experiments(arguments), tested_models(arguments),
      arguments.seeds.value_or(arguments.reduced ? kReducedSeeds : kSeeds), arguments.threads,
      [&](std::size_t done, std::size_t total) {
        bar.show(static_cast<double>(done) / static_cast<double>(total),
                 fmt::format("{} of {} simulations", done, total));
      },
      interrupt.token());
}

/// Writes a figure beside the page and returns its name; nothing where there is no figure.
std::string write_beside(const fs::path& page, const char* ending,
                         const std::optional<drawing::Drawing>& figure) {
  if (!figure) return "";
  const std::string name = page.stem().string() + ending;
  drawing::write_drawing(*figure, page.parent_path() / name);
  return name;
}

void report_comparison(const ValidateCrowdArguments& arguments) {
  check_ending("--output", arguments.output, {".md"});
  const validation::Comparison comparison = compare_with_people(arguments);
  if (arguments.as_json) fmt::print("{}", validation::comparison_json(comparison));
  if (arguments.output.empty()) {
    if (!arguments.as_json) fmt::print("{}", validation::markdown(comparison));
    return;
  }
  const fs::path page = arguments.output;
  validation::Figures figures;
  if (page.extension() == ".md") {  // no device
    figures.curves = write_beside(page, "_curves.svg", validation::curves_plot(comparison));
    figures.diagram = write_beside(page, "_diagram.svg", validation::diagram_plot(comparison));
  }
  write_file_atomically(page, validation::markdown(comparison, figures));
}

void run_tests(const ValidateCrowdArguments& arguments) {
  validation::Results results;
  {
    const Interrupt interrupt;
    ProgressBar bar("validation");
    results = validation::run_suite(
        tested_models(arguments), arguments.tests,
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
      "Run the RiMEA and NIST verification tests of pedestrian models, or compare them with "
      "recorded people (docs/validation.md)");
  const auto arguments = std::make_shared<ValidateCrowdArguments>();
  command
      ->add_option("-m,--models", arguments->models,
                   "Only these models (a,b,...); else all but dummy")
      ->type_name(model_words())
      ->delimiter(',');
  auto* tests =
      command->add_option("--tests", arguments->tests, "Only these tests (rimea_1,nist_2_8,...)")
          ->delimiter(',');
  auto* data =
      command
          ->add_option("--data", arguments->data,
                       "Folder of recorded experiments to repeat with the models instead of tests")
          ->excludes(tests);
  command->add_option("--experiments", arguments->experiments, "Only these experiments (a,b,...)")
      ->delimiter(',')
      ->needs(data);
  command
      ->add_option("--seeds", arguments->seeds,
                   "Simulations of each experiment with each model; else 20, reduced 2")
      ->check(CLI::Range(1, 1000))
      ->needs(data);
  command
      ->add_option(
          "--constants", arguments->constants,
          "Constants of ttc: best, posterior (each run draws them by its seed) or "
          "conservative; with others than best, ttc is tested alone unless -m names models")
      ->check(CLI::IsMember(
          std::vector<std::string>(crowd::kConstantsWords.begin(), crowd::kConstantsWords.end())));
  command->add_flag("--reduced", arguments->reduced, "Fewer people and runs: seconds per model");
  command->add_option("-j,--threads", arguments->threads, "Parallel tests (0: one per core)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output,
                      "File (Markdown) to write instead of standard output; with --data figures "
                      "(NAME_curves.svg, NAME_diagram.svg) beside it");
  command->add_flag("--json", arguments->as_json, "Print all values as JSON")->needs(data);
  command->callback([arguments, data] {
    if (data->count() > 0) {
      report_comparison(*arguments);
    } else {
      run_tests(*arguments);
    }
  });
}

}  // namespace throng::cli
