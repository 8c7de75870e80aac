#include "cli/assets/import_program.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/files/resources.h"

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

}  // namespace

void start_import(const std::string& kind, const CLI::App& command) {
  std::filesystem::path program =
      program_path().parent_path().parent_path() / "libexec/throng/throng-import";
  std::vector<std::string> words = import_arguments(command);
  words.insert(words.begin(), {program.string(), kind});
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(program.c_str(), pointers.data());
  throw EnvironmentError("cannot start " + program.string() + ": " + std::strerror(errno) +
                         (errno == ENOENT ? " (scripts/setup.sh builds it)" : ""));
}

}  // namespace throng::cli
