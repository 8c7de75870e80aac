// throng scenario import: becomes throng-import, with the options given.
#include "cli/assets/scenario_import.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/resources.h"
#include "cli/common/import_options.h"

namespace throng::cli {

namespace {

/// The words that give a command what it was given; values that begin with a dash stay values.
std::vector<std::string> import_arguments(const CLI::App& command) {
  std::vector<std::string> words;
  std::vector<std::string> positional{"--"};
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (option->get_positional()) {
        positional.push_back(value);
      } else {
        words.push_back("--" + option->get_lnames().front() + "=" + value);
      }
    }
  }
  words.insert(words.end(), positional.begin(), positional.end());
  return words;
}

void start_import(const CLI::App& command) {
  std::filesystem::path program =
      program_path().parent_path().parent_path() / "libexec/throng/throng-import";
  std::vector<std::string> words = import_arguments(command);
  words.insert(words.begin(), program.string());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(program.c_str(), pointers.data());
  throw EnvironmentError("cannot start " + program.string() + ": " + std::strerror(errno));
}

}  // namespace

void add_scenario_import(CLI::App& scenario) {
  auto* command = scenario.add_subcommand(
      "import", "Import a Gazebo world or an OpenStreetMap extract as a scenario");
  const auto options = std::make_shared<ImportOptions>();
  add_import_options(*command, *options);
  command->callback([options, command] { start_import(*command); });
}

}  // namespace throng::cli
