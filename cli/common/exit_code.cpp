#include "cli/common/exit_code.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>

#include "base/error.h"
#include "base/resource_exhaustion.h"

namespace throng::cli {

namespace {

/// Writes what is still in memory: a full disk or a closed pipe is seen only here.
void flush_output() {
  errno = 0;
  std::cout.flush();
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (!is_written) throw_environment_error("cannot write the output", errno != 0 ? errno : EIO);
}

}  // namespace

int run_program(const std::function<int()>& program) {
  try {
    const int code = program();
    flush_output();
    return code;
  } catch (const InputError& error) {
    fmt::print(stderr, "throng: {}\n", error.what());
    return exit_input;
  } catch (const Cancelled&) {
    fmt::print(stderr, "throng: cancelled\n");
    return exit_cancelled;
  } catch (const std::exception& error) {
    fmt::print(stderr, "throng: {}\n", error.what());
    return exit_environment;
  }
}

}  // namespace throng::cli
