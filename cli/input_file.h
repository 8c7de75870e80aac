// Files that a user names on the command line.
#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/files.h"

namespace throng::cli {

/// Throws InputError unless the file or folder is there: a wrong name is no failure of the machine.
inline void check_input_file(const std::string& name, const std::string& expected) {
  if (!std::filesystem::exists(name)) throw InputError({name, "", "no such file", expected});
}

/// The text of a file that a user named. Throws InputError if it is missing, a folder or not
/// readable.
inline std::string read_input_file(const std::string& name, const std::string& expected) {
  check_input_file(name, expected);
  if (std::filesystem::is_directory(name)) throw InputError({name, "", "a folder", expected});
  try {
    return read_file(name);
  } catch (const EnvironmentError&) {
    throw InputError({name, "", "a file that cannot be read", expected});
  }
}

}  // namespace throng::cli
