#include "cli/spec/exit_code.h"

#include <fmt/core.h>

#include <cstdio>
#include <exception>

#include "base/error.h"

namespace throng::cli {

int run_program(const std::function<int()>& program) {
  try {
    return program();
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
