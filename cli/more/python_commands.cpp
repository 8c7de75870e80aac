// throng train and throng match: commands of the Python package, which Python carries out.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/resources.h"
#include "cli/more/more_commands.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;

/// $THRONG_PYTHON; that of an active virtual environment; Debian's, whose packages torch and NumPy
/// are; the first of $PATH.
std::string python_program() {
  if (const char* given = std::getenv("THRONG_PYTHON")) return given;
  if (const char* venv = std::getenv("VIRTUAL_ENV")) return fs::path(venv) / "bin/python3";
  return fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
}

/// Replaces this process by `python3 -m MODULE ARGUMENT...`, which finds the package of the source
/// tree, if that still exists, behind an installed one, and this program as $THRONG_PROGRAM.
[[noreturn]] void run_module(const std::string& module, const std::vector<std::string>& arguments) {
  const fs::path package = source_folder() / "python";
  if (fs::is_directory(package / "throng")) {
    const char* path = std::getenv("PYTHONPATH");
    const std::string joined = path != nullptr && *path != '\0'
                                   ? std::string(path) + ":" + package.string()
                                   : package.string();
    ::setenv("PYTHONPATH", joined.c_str(), /*overwrite=*/1);
  }
  ::setenv("THRONG_PROGRAM", program_path().c_str(), /*overwrite=*/0);
  std::vector<std::string> words{python_program(), "-m", module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execvp(argv.front(), argv.data());
  throw EnvironmentError("cannot start " + words.front() + ": " + std::strerror(errno) +
                         "; install Python 3 with the package throng (docs/python.md)");
}

void add_module(CLI::App& app, const std::string& name, const std::string& about) {
  CLI::App* command = app.add_subcommand(name, about);
  // Everything behind the name, --help included, is Python's to understand.
  command->set_help_flag();
  command->footer("Its options: throng " + name + " --help");
  command->prefix_command();
  command->callback([command, name] { run_module("throng." + name, command->remaining()); });
}

}  // namespace

void add_train(CLI::App& app) {
  add_module(app, "train",
             "Train a detector or a counter on a job's or a dataset's images, and score it on "
             "images of your own (needs Python and torch; docs/training.md)");
}

void add_match(CLI::App& app) {
  add_module(app, "match",
             "Measure a real set of images, and write a job whose images resemble them (needs "
             "Python; docs/matching.md)");
}

}  // namespace throng::cli
