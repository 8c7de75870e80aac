#include "cli/program.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>

#include "base/error.h"
#include "base/version.h"
#include "cli/common/exit_code.h"
#include "cli/jobs/processes.h"
#include "cli/shell/command_line.h"
#include "cli/shell/commands.h"
#include "cli/shell/parse_error.h"

namespace throng::cli {

namespace {

constexpr std::array kCommands = {
    add_run,       add_check,  add_simulate,       add_render,     add_crowd,     add_serve,
    add_keys,      add_backup, add_remote_jobs,    add_people,     add_scenarios, add_scenario,
    add_airframes, add_study,  add_schema,         add_export,     add_merge,     add_publish,
    add_metrics,   add_report, add_remote_studies, add_completion, add_manual};

int run(int argc, char** argv, const Extension& extension) {
  CLI::App app{"Synthetic crowd datasets: simulate a crowd and drones, render, annotate."};
  app.footer(
      "Exit codes: 0 done, 2 the input is wrong, 3 the machine failed (retry), 130 cancelled.");
  app.set_version_flag("--version", std::string(kGenerator));
  app.require_subcommand(1);
  for (const auto add : kCommands) add(app);
  for (const auto add : extension.commands) add(app);
  add_worker(app, extension.tasks);
  add_confined(app, extension.confined_work);
  if (argc == 1) {
    fmt::print("{}", app.help());
    return exit_ok;
  }
  const CommandLine line(argc, argv);
  if (const auto help = help_text(app, line.words())) {
    fmt::print("{}", *help);
    return exit_ok;
  }
  check_commands(app, line.words());
  try {
    app.parse(line.count(), line.pointers());
  } catch (const CLI::Success& answer) {  // help, version
    return app.exit(answer);
  } catch (const CLI::RuntimeError& error) {  // of a command that has reported it
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    throw InputError(parse_problem(app, error, line.words()));
  }
  return exit_ok;
}

}  // namespace

int run_throng(int argc, char** argv, const Extension& extension) {
  return run_program([&] { return run(argc, argv, extension); });
}

}  // namespace throng::cli
