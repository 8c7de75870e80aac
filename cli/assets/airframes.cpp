// throng airframes: lists the built-in quadcopters, as templates for custom ones, and imports
// robots as airframes.
#include "spec/sim/airframe.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text/suggest.h"
#include "cli/assets/import_program.h"
#include "cli/common/import_options.h"
#include "cli/shell/commands.h"
#include "sim/vehicle/battery.h"

namespace throng::cli {

namespace {

void list_airframes(const std::vector<sim::Airframe>& frames) {
  constexpr double kSecondsPerMinute = 60;
  fmt::print("{:<14}{:>8}{:>10}{:>10}{:>11}{:>10}{:>9}\n", "airframe", "mass kg", "width m",
             "thrust/w", "speed m/s", "hover W", "minutes");
  for (const sim::Airframe& frame : frames) {
    const double minutes = sim::hover_endurance_s(frame) / kSecondsPerMinute;
    fmt::print("{:<14}{:>8.3f}{:>10.2f}{:>10.2f}{:>11.1f}{:>10.0f}{:>9}\n", frame.name,
               frame.mass_kg, 2 * frame.radius_m(), frame.max_thrust_n() / frame.weight_n(),
               frame.top_speed_mps(), sim::hover_power_w(frame),
               minutes > 0 ? fmt::format("{:.1f}", minutes) : "-");
  }
}

void print_airframe(const std::vector<sim::Airframe>& frames, const std::string& name) {
  std::vector<std::string_view> names;
  for (const sim::Airframe& frame : frames) {
    names.emplace_back(frame.name);
    if (frame.name != name) continue;
    fmt::print("{}\n", sim::to_json(frame).dump(2));
    return;
  }
  throw InputError(unknown_name("", "", "airframe", name, names));
}

void add_import(CLI::App& airframes) {
  auto* command = airframes.add_subcommand(
      "import", "Import a robot (SDF, URDF) as an airframe for a job's drones");
  const auto options = std::make_shared<AirframeImportOptions>();
  add_import_options(*command, *options);
  command->callback([options, command] { start_import(kImportAirframe, *command); });
}

}  // namespace

void add_airframes(CLI::App& app) {
  auto* command = app.add_subcommand("airframes",
                                     "List the quadcopters that a job can name, and import others");
  const auto name = std::make_shared<std::string>();
  command->add_option("name", *name,
                      "Print this one as JSON: a job's drones may have such an object as airframe");
  add_import(*command);
  command->callback([name, command] {
    if (!command->get_subcommands().empty()) return;
    const std::vector<sim::Airframe> frames = sim::shipped_airframes();
    if (name->empty()) {
      list_airframes(frames);
    } else {
      print_airframe(frames, *name);
    }
  });
}

}  // namespace throng::cli
