// The three kinds of failure: InputError (the user's input is wrong), EnvironmentError (the machine
// failed; a retry may help) and check() (the program has a bug and stops).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace throng {

/// One error in the user's input.
struct Problem {
  std::string source;    ///< File name, or "" for a request body.
  std::string where;     ///< JSON pointer ("/crowd/agents") or "line 12, element <Goal>".
  std::string found;     ///< The value found there.
  std::string expected;  ///< The value or form expected there.

  /// Returns "demo.job.json: /crowd/agents: found -3, expected an integer of at least 1". If
  /// `found` begins with "unknown ": `/drone: unknown field "drone"; did you mean "drones"?`. If
  /// `found` begins with "missing " or `expected` is empty, the text ends after `found`.
  std::string text() const;
};

/// The user's input is wrong. Holds all problems that were found; a retry cannot help.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Problem problem);
  explicit InputError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A failure outside the program: disk, driver, child process. A retry may help.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work was cancelled by the user.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Source location of a check: std::source_location, which clang 14 lacks.
struct CodeLocation {
  const char* file;
  int line;
  static constexpr CodeLocation here(const char* file = __builtin_FILE(),
                                     int line = __builtin_LINE()) {
    return {file, line};
  }
};

/// Aborts the program with `claim` on stderr unless `holds`. For conditions that only a bug can
/// violate, never for input.
void check(bool holds, std::string_view claim, CodeLocation location = CodeLocation::here());

}  // namespace throng
