// Exit codes of the program, and the one place that turns errors into them.
#pragma once

#include <functional>

namespace throng::cli {

/// Documented in `throng --help`.
enum ExitCode : int {
  exit_ok = 0,
  exit_input = 2,        ///< the input is wrong
  exit_environment = 3,  ///< the machine failed; a retry may help
  exit_cancelled = 130,
};

/// Runs a program; reports an error that it throws on stderr and returns the error's exit code.
int run_program(const std::function<int()>& program);

}  // namespace throng::cli
