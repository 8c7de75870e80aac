// throng-import: `throng scenario import` and `throng airframes import` as a program of their own
// (cli/common/import_options.h).
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/common/exit_code.h"
#include "cli/common/import_options.h"
#include "cli/import/import_airframe.h"
#include "cli/import/import_scenario.h"

namespace {

namespace cli = throng::cli;

int run(int argc, char** argv) {
  CLI::App app{
      "Imports Gazebo worlds and OpenStreetMap extracts as scenarios, and robots as airframes; "
      "`throng scenario import` and `throng airframes import` start it."};
  app.require_subcommand(1);
  auto* scenario = app.add_subcommand(cli::kImportScenario);
  cli::ImportOptions scenario_options;
  cli::add_import_options(*scenario, scenario_options);
  auto* airframe = app.add_subcommand(cli::kImportAirframe);
  cli::AirframeImportOptions airframe_options;
  cli::add_import_options(*airframe, airframe_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {  // help
    return app.exit(answer);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "throng-import: {}\n", error.what());
    return cli::exit_input;
  }
  if (scenario->parsed()) {
    cli::import_scenario(scenario_options);
  } else {
    cli::import_airframe(airframe_options);
  }
  return cli::exit_ok;
}

}  // namespace

int main(int argc, char** argv) {
  return throng::cli::run_program([&] { return run(argc, argv); });
}
