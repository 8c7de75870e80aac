#include "cli/common/import_options.h"

#include <CLI/CLI.hpp>

namespace throng::cli {

void add_import_options(CLI::App& command, ImportOptions& options) {
  command.add_option("file", options.file, "WORLD.sdf, WORLD.world or MAP.osm")->required();
  command.add_option("-o,--output", options.folder, "Folder of scenarios to write into")
      ->required();
  command.add_option("--people", options.people, "Number of people at the start")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Seed of the initial positions")
      ->capture_default_str();
  command.add_option("--exit", options.exits,
                     "x1,y1,x2,y2 in meters, may be repeated; default: detected at the boundary");
  command.add_option("--models", options.models,
                     "SDF: folder for model://, may be repeated; always: the world's own");
  command.add_option("--origin", options.origin,
                     "OSM: latitude,longitude of (0, 0); default: the middle of the extract");
}

void add_import_options(CLI::App& command, AirframeImportOptions& options) {
  command.add_option("file", options.file, "ROBOT.sdf or ROBOT.urdf")->required();
  command.add_option("-o,--output", options.output, "AIRFRAME.json; default: standard output");
  command.add_option("--base", options.base,
                     "Shipped airframe with the rotors, drag and autopilot that the file lacks");
  command.add_option("--camera", options.camera,
                     "Name of the sensor that becomes the camera; default: the first in color");
  command.add_option("--models", options.models,
                     "Folder for model:// and package://, may be repeated; always: the folders of "
                     "the file and above");
}

}  // namespace throng::cli
