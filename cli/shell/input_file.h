// Files that a user names on the command line.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"

namespace throng::cli {

/// Throws InputError unless the file or folder exists.
inline void check_input_file(const std::string& name, const std::string& expected) {
  if (!std::filesystem::exists(name)) throw InputError({name, "", "no such file", expected});
}

/// Throws InputError if the output file is one of the input files.
inline void check_output_file(const std::string& option, const std::string& output,
                              const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code error;  // missing files are reported elsewhere
    if (!output.empty() && std::filesystem::equivalent(output, input, error)) {
      throw InputError({option, "", output + ", which is an input", "another file"});
    }
  }
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
