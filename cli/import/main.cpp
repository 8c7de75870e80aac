// throng-import: `throng scenario import` as a program of its own (cli/common/import_options.h).
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/common/exit_code.h"
#include "cli/common/import_options.h"
#include "cli/import/import_scenario.h"

namespace {

namespace cli = throng::cli;

int run(int argc, char** argv) {
  CLI::App app{
      "Imports a Gazebo world or an OpenStreetMap extract; `throng scenario import` starts it."};
  cli::ImportOptions options;
  cli::add_import_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {  // help
    return app.exit(answer);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "throng-import: {}\n", error.what());
    return cli::exit_input;
  }
  cli::import_scenario(options);
  return cli::exit_ok;
}

}  // namespace

int main(int argc, char** argv) {
  return throng::cli::run_program([&] { return run(argc, argv); });
}
