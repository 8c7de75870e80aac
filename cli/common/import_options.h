// Options of `throng scenario import`, which the program hands on to throng-import (cli/import): a
// program of its own, because the libraries that read Gazebo's worlds take as long to start as all
// others together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace throng::cli {

struct ImportOptions {
  std::string file;
  std::string folder;
  int people = 100;
  std::uint64_t seed = 1;
  std::vector<std::string> exits;   ///< x1,y1,x2,y2 in meters
  std::vector<std::string> models;  ///< folders for model://
  std::string origin;               ///< latitude,longitude in degrees; empty: the middle
};

/// `options` must live as long as the command.
void add_import_options(CLI::App& command, ImportOptions& options);

}  // namespace throng::cli
