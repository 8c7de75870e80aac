// Traversal of the program's commands, for the manual page and shell completion.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace throng::cli {

/// Subcommands for users, in the order of the help; internal ones such as workers are left out.
std::vector<const CLI::App*> user_subcommands(const CLI::App& command);

/// Visits the command and its subcommands for users in pre-order. `words` are the words of the
/// command ("throng scenario check").
void for_each_command(const CLI::App& command, const std::string& words,
                      const std::function<void(const CLI::App&, const std::string&)>& visit);

}  // namespace throng::cli
