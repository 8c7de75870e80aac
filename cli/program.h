// The program `throng`: its subcommands in one table.
#pragma once

#include <vector>

#include "jobs/pipeline/confined_work.h"
#include "jobs/pipeline/worker.h"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace throng::cli {

/// Parts of a program that this module does not have.
struct Extension {
  std::vector<void (*)(CLI::App&)> commands;  ///< each adds a subcommand
  jobs::OtherTasks tasks;                     ///< of `throng worker`
  jobs::ConfinedWork confined_work;           ///< of `throng confined`
};

/// Performs the command that the arguments name. Prints problems; returns the exit code
/// (exit_code.h).
int run_throng(int argc, char** argv, const Extension& extension);

}  // namespace throng::cli
