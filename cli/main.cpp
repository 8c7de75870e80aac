// `throng`: synthetic crowd datasets from the command line. One subcommand per file.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>

#include "base/error.h"
#include "base/version.h"
#include "cli/common/exit_code.h"
#include "cli/shell/command_line.h"
#include "cli/shell/commands.h"
#include "cli/shell/parse_error.h"

namespace {

namespace cli = throng::cli;
using throng::InputError;

constexpr std::array kCommands = {
    cli::add_run,          cli::add_check,       cli::add_simulate,  cli::add_live,
    cli::add_render,       cli::add_crowd,       cli::add_serve,     cli::add_keys,
    cli::add_backup,       cli::add_remote_jobs, cli::add_worker,    cli::add_confined,
    cli::add_live_process, cli::add_people,      cli::add_scenarios, cli::add_scenario,
    cli::add_airframes,    cli::add_study,       cli::add_schema,    cli::add_export,
    cli::add_merge,        cli::add_publish,     cli::add_validate,  cli::add_validate_crowd,
    cli::add_metrics,      cli::add_report,      cli::add_calibrate, cli::add_remote_studies,
    cli::add_completion,   cli::add_manual};

int run(int argc, char** argv) {
  CLI::App app{"Synthetic crowd datasets: simulate a crowd and drones, render, annotate."};
  app.footer(
      "Exit codes: 0 done, 2 the input is wrong, 3 the machine failed (retry), 130 cancelled.");
  app.set_version_flag("--version", std::string(throng::kGenerator));
  app.require_subcommand(1);
  for (const auto add : kCommands) add(app);
  if (argc == 1) {
    fmt::print("{}", app.help());
    return cli::exit_ok;
  }
  const cli::CommandLine line(argc, argv);
  if (const auto help = cli::help_text(app, line.words())) {
    fmt::print("{}", *help);
    return cli::exit_ok;
  }
  cli::check_commands(app, line.words());
  try {
    app.parse(line.count(), line.pointers());
  } catch (const CLI::Success& answer) {  // help, version
    return app.exit(answer);
  } catch (const CLI::RuntimeError& error) {  // of a command that has reported it
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    throw InputError(cli::parse_problem(app, error, line.words()));
  }
  return cli::exit_ok;
}

}  // namespace

int main(int argc, char** argv) {
  return cli::run_program([&] { return run(argc, argv); });
}
