#include "spec/job/environment.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/geometry/angle.h"
#include "spec/sun/sun_times.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr int kMinutesPerHour = 60;
constexpr int kDaysPerYear = 365;
constexpr std::array kWeathers{"clear", "overcast", "fog", "rain"};

std::optional<double> parse_hours(const json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto& text = value.get_ref<const std::string&>();
  const auto digit = [&](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
  if (text.size() != 5 || text[2] != ':' || !digit(0) || !digit(1) || !digit(3) || !digit(4)) {
    return std::nullopt;
  }
  const int hours = std::stoi(text.substr(0, 2));
  const int minutes = std::stoi(text.substr(3));
  if (hours > 23 || minutes >= kMinutesPerHour) return std::nullopt;
  return hours + minutes / double{kMinutesPerHour};
}

std::string time_text(double hours) {
  const long minutes = std::lround(hours * kMinutesPerHour);
  return fmt::format("{:02}:{:02}", minutes / kMinutesPerHour, minutes % kMinutesPerHour);
}

Quantity time_quantity() {
  return {"a time HH:MM, for example \"15:30\", or a word such as \"dusk\"",
          parse_hours,
          [](double hours) { return json(time_text(hours)); },
          0,
          24 - 1.0 / kMinutesPerHour,
          true};
}

Values times() {
  return {{{"type", "string"},
           {"pattern", fmt::format("^(([01][0-9]|2[0-3]):[0-5][0-9]|{})$", kSunWordsPattern)}},
          "",
          time_quantity()};
}

std::string environment_pointer(const char* name) { return fmt::format("/environment/{}", name); }

double usual_visibility_m(render::Weather weather) {
  switch (weather) {
    case render::Weather::overcast:
      return 15000;
    case render::Weather::fog:
      return 800;
    case render::Weather::rain:
      return 5000;
    case render::Weather::clear:
      break;
  }
  return 20000;
}

}  // namespace

const FieldTable<EnvironmentSpec>& environment_fields() {
  static const FieldTable<EnvironmentSpec> fields = [] {
    FieldTable<EnvironmentSpec> table;
    add_sampled(
        table, "time_of_day", "Time of day", "HH:MM", times(), at(&EnvironmentSpec::time_of_day_h),
        "Solar time at the run's start; sets the sun for the whole run: HH:MM, or midnight, "
        "dawn, sunrise, noon, sunset or dusk, also as \"sunset-20min\" or \"dusk+1h\". "
        "Street lamps and windows are lit while it is below the horizon.");
    add_sampled(table, "latitude_deg", "Latitude", "degrees", numbers(-90, 90),
                at(&EnvironmentSpec::latitude_deg),
                "Latitude for the sun's position; north is positive.");
    add_sampled(table, "day_of_year", "Day of the year", "days", integers(1, kDaysPerYear),
                at(&EnvironmentSpec::day_of_year), "1 is 1 January; 225 is mid-August.");
    add_sampled(
        table, "weather", "Weather", "", sampled_words(kWeathers), at(&EnvironmentSpec::weather),
        "clear: sun and shadows; overcast: diffuse light without hard shadows; fog: contrast falls "
        "with distance; rain: overcast, streaks, a wet ground with puddles.");
    add_sampled(table, "visibility_m", "Visibility", "m", numbers(20, 100000),
                at(&EnvironmentSpec::visibility_m),
                "Distance at which 2 % of a contrast is left; default, by the weather: 20000 "
                "(clear), 15000 (overcast), 800 (fog), 5000 (rain).");
    add_sampled(table, "smoke", "Smoke", "", numbers(0, 1), at(&EnvironmentSpec::smoke),
                "Density of smoke and dust around the scenario's hazards (disaster_agents); it "
                "hides objects in the image, not in the ground truth.");
    add_sampled(table, "rain_mm_per_h", "Rain", "mm/h", numbers(0, 200),
                at(&EnvironmentSpec::rain_mm_per_h),
                "Intensity of the rain if the weather is rain.");
    table.group("wind", "Wind", "The wind that acts on drones and smoke.");
    table.add_all("wind", wind_fields(), at(&EnvironmentSpec::wind));
    return table;
  }();
  return fields;
}

EnvironmentSpec read_environment(const json& value, std::vector<Problem>& problems) {
  EnvironmentSpec spec;
  const std::string no_source;
  environment_fields().read(value, spec, {"/environment", no_source, problems});
  return spec;
}

json to_json(const EnvironmentSpec& spec) { return environment_fields().print(spec); }

RunEnvironment environment_of_run(const EnvironmentSpec& spec, std::uint64_t run_seed) {
  const auto draw = [&](const Distribution& distribution, const char* name) {
    return distribution.draw(run_seed, environment_pointer(name));
  };
  RunEnvironment run;
  // Whole minutes, so that the record says all.
  constexpr double kSlack = 1e-6;
  run.time_of_day_h =
      std::floor(draw(spec.time_of_day_h, "time_of_day") * kMinutesPerHour + kSlack) /
      kMinutesPerHour;
  run.latitude_deg = draw(spec.latitude_deg, "latitude_deg");
  run.day_of_year = static_cast<int>(std::lround(draw(spec.day_of_year, "day_of_year")));
  const Sun sun = sun_at(run.time_of_day_h, run.latitude_deg, run.day_of_year);
  run.light.sun_azimuth_rad = sun.azimuth_rad;
  run.light.sun_elevation_rad = sun.elevation_rad;
  run.light.weather = static_cast<render::Weather>(draw(spec.weather, "weather"));
  run.light.visibility_m = spec.visibility_m ? draw(*spec.visibility_m, "visibility_m")
                                             : usual_visibility_m(run.light.weather);
  if (run.light.weather == render::Weather::rain) {
    run.light.rain_mm_per_h = draw(spec.rain_mm_per_h, "rain_mm_per_h");
  }
  run.light.smoke = draw(spec.smoke, "smoke");
  run.light.seed = run_seed;
  run.wind = wind_of_run(spec.wind, run_seed);
  constexpr double kSmokeM = 5;  // above the ground, where most of a hazard's smoke is
  run.light.wind_mps = run.wind.mean_at(kSmokeM).head<2>();
  return run;
}

json to_json(const RunEnvironment& environment) {
  const render::Environment& light = environment.light;
  return {{"time_of_day", time_text(environment.time_of_day_h)},
          {"latitude_deg", environment.latitude_deg},
          {"day_of_year", environment.day_of_year},
          {"sun_azimuth_deg", light.sun_azimuth_rad / kDegree},
          {"sun_elevation_deg", light.sun_elevation_rad / kDegree},
          {"weather", kWeathers.at(static_cast<std::size_t>(light.weather))},
          {"visibility_m", light.visibility_m},
          {"rain_mm_per_h", light.rain_mm_per_h},
          {"smoke", light.smoke},
          {"wind", to_json(environment.wind)}};
}

}  // namespace throng::jobs
