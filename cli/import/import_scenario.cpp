#include "cli/import/import_scenario.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "places/imports/imports.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;

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

std::vector<imports::Gate> read_gates(const ImportOptions& options) {
  constexpr double kMaxCoordinateM = 10'000;
  constexpr double kMinWidthM = 0.8;
  std::vector<imports::Gate> gates;
  for (const std::string& text : options.exits) {
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

imports::ImportedScenario read_source(const ImportOptions& options) {
  const fs::path file = options.file;
  const std::string suffix = file.extension().string();
  if (!fs::is_regular_file(file)) {
    throw InputError({options.file, "", "no file", "a world (.sdf, .world) or a map (.osm)"});
  }
  if (suffix == ".sdf" || suffix == ".world") {
    imports::SdfOptions sdf;
    for (const std::string& folder : options.models) {
      if (!fs::is_directory(folder)) {
        throw InputError({"--models", "", folder + ", which is no folder", "a folder of models"});
      }
    }
    sdf.models.assign(options.models.begin(), options.models.end());
    sdf.gates = read_gates(options);
    return imports::read_sdf(file, sdf);
  }
  if (suffix == ".osm") {
    imports::OsmOptions osm;
    osm.gates = read_gates(options);
    if (!options.origin.empty()) {
      const auto [latitude, longitude] =
          numbers_in<2>(options.origin, "--origin", "latitude,longitude in degrees");
      osm.origin = imports::GeoPoint{latitude, longitude};
    }
    return imports::read_osm(file, osm);
  }
  throw InputError({options.file, "", "suffix \"" + suffix + "\"", ".sdf, .world or .osm"});
}

/// Gives the drones of robots their airframes; robots that are no quadcopters are listed.
void add_airframes(const ImportOptions& options, imports::ImportedScenario& scenario) {
  for (imports::ImportedDrone& drone : scenario.drones) {
    if (drone.robot_file.empty()) continue;
    const std::string file = drone.robot_file.string();
    try {
      const imports::Robot robot =
          imports::read_robot(file, {options.models.begin(), options.models.end()});
      std::vector<std::string> assumptions;
      drone.airframe = imports::airframe_json(robot, file, {}, assumptions);
    } catch (const InputError& error) {
      const Problem& problem = error.problems().front();
      scenario.skipped.push_back({file, 0, "airframe of " + drone.id, problem.text()});
    }
  }
}

}  // namespace

void import_scenario(const ImportOptions& options) {
  imports::ImportedScenario scenario = read_source(options);
  add_airframes(options, scenario);
  const imports::Population population =
      imports::populate(scenario, {options.people, options.seed});
  const fs::path written = imports::write_imported_scenario(scenario, population, options.folder);
  for (const imports::Skipped& skipped : scenario.skipped) {
    fmt::print(stderr, "skipped: {}\n", skipped.text());
  }
  fmt::print("{}: {:.0f} m x {:.0f} m, {} buildings, {} props, {} exits, {} people, {} skipped\n",
             written.string(), scenario.inside.max.x() - scenario.inside.min.x(),
             scenario.inside.max.y() - scenario.inside.min.y(), scenario.buildings.size(),
             scenario.objects.size() + scenario.props.size(), population.gates.size(),
             population.starts.size(), scenario.skipped.size());
}

}  // namespace throng::cli
