// throng scenarios: what places there are.
#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "cli/commands.h"
#include "world/scenario.h"

namespace throng::cli {

void add_scenarios(CLI::App& app) {
  auto* command = app.add_subcommand("scenarios", "List the scenarios that a job can name");
  command->callback([] {
    const auto folder = world::scenarios_folder();
    for (const std::string& id : world::list_scenarios(folder)) {
      fmt::print("{:<32} {}\n", id, world::find_scenario(folder, id).name);
    }
  });
}

}  // namespace throng::cli
