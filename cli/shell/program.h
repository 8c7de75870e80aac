// The program `throng`: its subcommands in one table.
#pragma once

namespace throng::cli {

/// Performs the command that the arguments name. Prints problems; returns the exit code
/// (exit_code.h).
int run_throng(int argc, char** argv);

}  // namespace throng::cli
