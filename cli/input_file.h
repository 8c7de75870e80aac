// Files that a user names on the command line.
#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"

namespace throng::cli {

/// Throws InputError unless the file or folder is there: a wrong name is no failure of the machine.
inline void check_input_file(const std::string& name, const std::string& expected) {
  if (!std::filesystem::exists(name)) throw InputError({name, "", "no such file", expected});
}

}  // namespace throng::cli
