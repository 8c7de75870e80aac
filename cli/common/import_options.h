// Options of `throng scenario import`, which the program passes on to throng-import (cli/import).
// That is a separate program, because loading the libraries that read Gazebo's worlds takes as long
// as loading all others together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace throng::cli {

/// Values of the options.
struct ImportOptions {
  std::string file;    ///< file to import
  std::string folder;  ///< folder of the new scenario
  int people = 100;    ///< number of people
  std::uint64_t seed = 1;
  std::vector<std::string> exits;   ///< x1,y1,x2,y2 in meters
  std::vector<std::string> models;  ///< folders in which model:// URIs are searched
  std::string origin;               ///< latitude,longitude in degrees; "": center of the map
};

/// Adds the options to a command. `options` must outlive it.
void add_import_options(CLI::App& command, ImportOptions& options);

}  // namespace throng::cli
