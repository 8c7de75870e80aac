// Preprocessing of the command line before the parser: renamed options, `throng help`, and
// misspelled commands, which the parser would report as a missing command.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace throng::cli {

/// The command line with deprecated option names replaced; each replacement is reported on stderr.
class CommandLine {
 public:
  CommandLine(int argc, const char* const* argv);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The words without the program's name.
  std::span<const std::string> words() const { return std::span(words_).subspan(1); }
  int count() const { return static_cast<int>(words_.size()); }
  const char* const* pointers() const { return pointers_.data(); }

 private:
  std::vector<std::string> words_;
  std::vector<const char*> pointers_;  ///< into words_
};

/// The help for `help [COMMAND...]`; std::nullopt for other words. Throws InputError for an unknown
/// command.
std::optional<std::string> help_text(const CLI::App& app, std::span<const std::string> words);

/// Throws InputError for a misspelled command; the message suggests the nearest one.
void check_commands(const CLI::App& app, std::span<const std::string> words);

}  // namespace throng::cli
