// The commands of the program as a tree, for its manual page and the completion of shells.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace throng::cli {

/// Subcommands that users start, in the order of the help; workers are started by the service.
std::vector<const CLI::App*> user_subcommands(const CLI::App& command);

/// Visits the command and all that users start below it, each before its own, with the words that
/// start it
/// ("throng scenario check").
void for_each_command(const CLI::App& command, const std::string& words,
                      const std::function<void(const CLI::App&, const std::string&)>& visit);

}  // namespace throng::cli
