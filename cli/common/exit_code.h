// Exit codes of the program and the mapping from exceptions to them.
#pragma once

#include <functional>

namespace throng::cli {

/// Exit codes, as documented in `throng --help`.
enum ExitCode : int {
  exit_ok = 0,
  exit_input = 2,        ///< the input is wrong
  exit_environment = 3,  ///< the machine failed; a retry may help
  exit_cancelled = 130,
};

/// Calls `program` and returns its exit code. If it throws, reports the error on stderr and returns
/// the error's exit code.
int run_program(const std::function<int()>& program);

}  // namespace throng::cli
