// throng people import: characters of the user's own as members of a population.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/shell/commands.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "skinning/import/import.h"

namespace throng::cli {

namespace {

struct ImportArguments {
  std::vector<std::string> descriptions;
  std::string output;
  skinning::ImportOptions options;
};

void import_all(const ImportArguments& arguments) {
  const Interrupt interrupt;
  ProgressBar bar("importing characters");
  skinning::import_characters({arguments.descriptions.begin(), arguments.descriptions.end()},
                              arguments.output, arguments.options, [&](int done, int count) {
                                if (interrupt.token().stop_requested()) throw Cancelled();
                                bar.show(static_cast<double>(done) / count,
                                         fmt::format("{} of {}", done, count));
                              });
}

}  // namespace

void add_people_import(CLI::App& people) {
  auto* command = people.add_subcommand(
      "import", "Import rigged models (glTF, FBX, DAE) as characters: see docs/people.md");
  const auto arguments = std::make_shared<ImportArguments>();
  command->add_option("descriptions", arguments->descriptions, "JSON description of each character")
      ->required();
  command->add_option("--with", arguments->options.with,
                      "Character library to add them to; may be the output");
  command
      ->add_option("--texture-size", arguments->options.texture_size,
                   "Texture size in pixels, unless --with has another")
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Folder to write")->required();
  command->callback([arguments] { import_all(*arguments); });
}

}  // namespace throng::cli
