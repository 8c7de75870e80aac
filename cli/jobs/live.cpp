// throng live: the process of a live flight, for the service.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>
#include <string>

#include "cli/shell/commands.h"
#include "jobs/live/session.h"

namespace throng::cli {

void add_live(CLI::App& app) {
  auto* command = app.add_subcommand("live", "Fly a job's drones by commands");
  command->group("");  // not for users
  const auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "Folder with the job")->required();
  command->callback([folder] { std::exit(live::run_session(*folder)); });
}

}  // namespace throng::cli
