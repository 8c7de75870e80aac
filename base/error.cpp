#include "base/error.h"

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>

namespace throng {

namespace {

std::string join(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.text();
  }
  return text;
}

}  // namespace

std::string Problem::text() const {
  std::string place = source;
  if (!source.empty() && !where.empty()) place += ": ";
  place += where;
  if (!place.empty()) place += ": ";
  if (expected.empty() || found.starts_with("missing ")) return place + found;
  if (!found.starts_with("unknown ")) {
    return fmt::format("{}found {}, expected {}", place, found, expected);
  }
  return expected.starts_with('"') ? fmt::format("{}{}; did you mean {}?", place, found, expected)
                                   : fmt::format("{}{}; expected {}", place, found, expected);
}

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

void check(bool holds, std::string_view claim, CodeLocation location) {
  if (holds) return;
  fmt::print(stderr, "throng bug at {}:{}: {}\n", location.file, location.line, claim);
  std::fflush(stderr);
  std::abort();
}

}  // namespace throng
