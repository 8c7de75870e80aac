// Starts throng-import (cli/import), the program that reads Gazebo's files, with a command's
// options.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace throng::cli {

/// Becomes throng-import, which imports a `kind` (cli/common/import_options.h) with the options
/// that `command` was given. Returns only by throwing EnvironmentError.
[[noreturn]] void start_import(const std::string& kind, const CLI::App& command);

}  // namespace throng::cli
