// throng scenario import: worlds and maps of others as scenarios.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/scenario_import.h"
#include "imports/imports.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;

struct PlaceArguments {
  std::string file;
  std::string folder;
  imports::PopulateOptions population;
  std::vector<std::string> exits;
  std::vector<std::string> models;
  std::string origin;
};

/// COUNT numbers with commas between.
template <std::size_t count>
std::array<double, count> numbers_in(const std::string& text, const std::string& option,
                                     const std::string& expected) {
  std::array<double, count> numbers{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    const bool last = i + 1 == count;
    const bool good = error == std::errc() && std::isfinite(numbers[i]);
    if (!good || (last ? next != end : next == end || *next != ',')) {
      throw InputError({option, "", "\"" + text + "\"", expected});
    }
    at = next + (last ? 0 : 1);
  }
  return numbers;
}

std::vector<imports::Gate> gates_of(const PlaceArguments& arguments) {
  constexpr double kMaxCoordinateM = 10'000;
  constexpr double kMinWidthM = 0.8;
  std::vector<imports::Gate> gates;
  for (const std::string& text : arguments.exits) {
    const auto [x1, y1, x2, y2] = numbers_in<4>(text, "--exit", "x1,y1,x2,y2 in meters");
    const imports::Gate gate{{x1, y1}, {x2, y2}, std::hypot(x2 - x1, y2 - y1)};
    const double farthest =
        std::max(gate.from.cwiseAbs().maxCoeff(), gate.to.cwiseAbs().maxCoeff());
    if (farthest > kMaxCoordinateM || gate.share < kMinWidthM) {
      throw InputError({"--exit", "", text, "a segment of at least 0.8 m within 10 km"});
    }
    gates.push_back(gate);
  }
  return gates;
}

imports::Place place_of(const PlaceArguments& arguments) {
  const fs::path file = arguments.file;
  const std::string suffix = file.extension().string();
  if (!fs::is_regular_file(file)) {
    throw InputError({arguments.file, "", "no file", "a world (.sdf, .world) or a map (.osm)"});
  }
  if (suffix == ".sdf" || suffix == ".world") {
    imports::SdfOptions options;
    options.models.assign(arguments.models.begin(), arguments.models.end());
    options.gates = gates_of(arguments);
    return imports::read_sdf(file, options);
  }
  if (suffix == ".osm") {
    imports::OsmOptions options;
    options.gates = gates_of(arguments);
    if (!arguments.origin.empty()) {
      const auto [latitude, longitude] =
          numbers_in<2>(arguments.origin, "--origin", "latitude,longitude in degrees");
      options.origin = imports::GeoPoint{latitude, longitude};
    }
    return imports::read_osm(file, options);
  }
  throw InputError({arguments.file, "", "suffix \"" + suffix + "\"", ".sdf, .world or .osm"});
}

void import_place(const PlaceArguments& arguments) {
  imports::Place place = place_of(arguments);
  const imports::Population population = imports::populate(place, arguments.population);
  const fs::path written = imports::write_place(place, population, arguments.folder);
  for (const imports::Skipped& skipped : place.skipped) {
    fmt::print(stderr, "skipped: {}\n", skipped.text());
  }
  fmt::print("{}: {:.0f} m x {:.0f} m, {} buildings, {} props, {} exits, {} people, {} skipped\n",
             written.string(), place.inside.max.x() - place.inside.min.x(),
             place.inside.max.y() - place.inside.min.y(), place.buildings.size(),
             place.objects.size() + place.props.size(), population.gates.size(),
             population.starts.size(), place.skipped.size());
}

}  // namespace

void add_scenario_import(CLI::App& scenario) {
  auto* command = scenario.add_subcommand(
      "import", "Import a Gazebo world or an OpenStreetMap extract as a scenario");
  const auto arguments = std::make_shared<PlaceArguments>();
  command->add_option("file", arguments->file, "WORLD.sdf, WORLD.world or MAP.osm")->required();
  command->add_option("-o,--output", arguments->folder, "Folder of scenarios to write into")
      ->required();
  command->add_option("--people", arguments->population.people, "Number of people at the start")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command->add_option("--seed", arguments->population.seed, "Seed of the initial positions")
      ->capture_default_str();
  command->add_option("--exit", arguments->exits,
                      "x1,y1,x2,y2 in meters, may be repeated; default: detected at the boundary");
  command->add_option("--models", arguments->models,
                      "SDF: folder for model://, may be repeated; always: the world's own");
  command->add_option("--origin", arguments->origin,
                      "OSM: latitude,longitude of (0, 0); default: the middle of the extract");
  command->callback([arguments] { import_place(*arguments); });
}

}  // namespace throng::cli
