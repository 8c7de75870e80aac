#include "cli/import/import_airframe.h"

#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/suggest.h"
#include "places/imports/imports.h"
#include "spec/sim/airframe.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;

imports::AirframeChoices read_choices(const AirframeImportOptions& options) {
  imports::AirframeChoices choices;
  choices.camera = options.camera;
  if (options.base.empty()) return choices;
  choices.base = sim::find_airframe(options.base);
  if (choices.base) return choices;
  const std::vector<sim::Airframe> shipped = sim::shipped_airframes();
  std::vector<std::string_view> names;
  names.reserve(shipped.size());
  for (const sim::Airframe& airframe : shipped) names.emplace_back(airframe.name);
  throw InputError(unknown_name("--base", "", "airframe", options.base, names));
}

}  // namespace

void import_airframe(const AirframeImportOptions& options) {
  for (const std::string& folder : options.models) {
    if (!fs::is_directory(folder)) {
      throw InputError({"--models", "", folder + ", which is no folder", "a folder of models"});
    }
  }
  const imports::AirframeChoices choices = read_choices(options);
  const imports::Robot robot =
      imports::read_robot(options.file, {options.models.begin(), options.models.end()});
  std::vector<std::string> assumptions;
  const nlohmann::ordered_json airframe =
      imports::airframe_json(robot, options.file, choices, assumptions);
  for (const imports::Skipped& skipped : robot.skipped) {
    fmt::print(stderr, "skipped: {}\n", skipped.text());
  }
  for (const std::string& assumption : assumptions) {
    fmt::print(stderr, "assumed: {}\n", assumption);
  }
  constexpr int kIndent = 1;
  const std::string text = airframe.dump(kIndent) + "\n";
  if (options.output.empty()) {
    fmt::print("{}", text);
  } else {
    write_file_atomically(options.output, text);
    fmt::print("{}: {:.4g} kg, {} cameras, {} skipped, {} assumed\n", options.output, robot.mass_kg,
               robot.cameras.size(), robot.skipped.size(), assumptions.size());
  }
}

}  // namespace throng::cli
