// Options of `throng scenario import` and `throng airframes import`, which the program passes on to
// throng-import (cli/import). That is a separate program, because loading the libraries that read
// Gazebo's files takes as long as loading all others together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace throng::cli {

/// Names of what throng-import imports, its subcommands.
inline constexpr const char* kImportScenario = "scenario";
inline constexpr const char* kImportAirframe = "airframe";

/// Values of the options of a scenario's import.
struct ImportOptions {
  std::string file;    ///< file to import
  std::string folder;  ///< folder of the new scenario
  int people = 100;    ///< number of people
  std::uint64_t seed = 1;
  std::vector<std::string> exits;   ///< x1,y1,x2,y2 in meters
  std::vector<std::string> models;  ///< folders in which model:// URIs are searched
  std::string origin;               ///< latitude,longitude in degrees; "": center of the map
};

/// Values of the options of an airframe's import.
struct AirframeImportOptions {
  std::string file;    ///< robot to import
  std::string output;  ///< file of the airframe; "": standard output
  std::string base;    ///< airframe that gives what the description does not; "": none
  std::string camera;  ///< the sensor that becomes the drone's camera; "": the first in color
  std::vector<std::string> models;  ///< folders in which model:// and package:// are searched
};

/// Adds the options to a command. `options` must outlive it.
void add_import_options(CLI::App& command, ImportOptions& options);
void add_import_options(CLI::App& command, AirframeImportOptions& options);

}  // namespace throng::cli
