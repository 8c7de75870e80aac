// Messages for invalid command lines, in the form of all other errors.
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

#include "base/error.h"

namespace throng::cli {

/// The mistake in the command line of the last app.parse(): the option, what was found and what is
/// expected, or the nearest known option.
Problem parse_problem(const CLI::App& app, const CLI::ParseError& error,
                      std::span<const std::string> words);

}  // namespace throng::cli
