#include "jobs/spec/environment.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angle.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr int kMinutesPerHour = 60;
constexpr int kDaysPerYear = 365;
constexpr std::array kWeathers{"clear", "overcast", "fog", "rain"};

std::optional<double> hours_of(const json& value) {
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
  return {"a time HH:MM, for example \"15:30\"",
          hours_of,
          [](double hours) { return json(time_text(hours)); },
          0,
          24 - 1.0 / kMinutesPerHour,
          true};
}

Quantity day_quantity() {
  Quantity days = number_quantity(1, kDaysPerYear);
  days.expected = fmt::format("an integer from 1 to {}", kDaysPerYear);
  days.number = [number = days.number](const json& value) {
    return value.is_number_integer() ? number(value) : std::nullopt;
  };
  days.json = [](double day) { return json(static_cast<int>(day)); };
  return days;
}

Quantity weather_quantity() {
  return {R"(one of "clear", "overcast", "fog", "rain")",
          [](const json& value) -> std::optional<double> {
            const auto found = std::find(kWeathers.begin(), kWeathers.end(), value);
            if (found == kWeathers.end()) return std::nullopt;
            return static_cast<double>(found - kWeathers.begin());
          },
          [](double index) { return json(kWeathers.at(static_cast<std::size_t>(index))); },
          0,
          kWeathers.size() - 1.0,
          false};
}

/// A field of the job: its name, how it writes values, and where it is kept.
struct Field {
  const char* name;
  Quantity quantity;
  Distribution EnvironmentSpec::*value;
};

const std::array<Field, 6>& fields() {
  static const std::array<Field, 6> list = {
      {{"time_of_day", time_quantity(), &EnvironmentSpec::time_of_day_h},
       {"latitude_deg", number_quantity(-90, 90), &EnvironmentSpec::latitude_deg},
       {"day_of_year", day_quantity(), &EnvironmentSpec::day_of_year},
       {"weather", weather_quantity(), &EnvironmentSpec::weather},
       {"rain_mm_per_h", number_quantity(0, 200), &EnvironmentSpec::rain_mm_per_h},
       {"smoke", number_quantity(0, 1), &EnvironmentSpec::smoke}}};
  return list;
}

const Quantity& visibility_quantity() {
  static const Quantity quantity = number_quantity(20, 100'000);
  return quantity;
}

std::string pointer_of(const char* name) { return fmt::format("/environment/{}", name); }

double usual_visibility_m(render::Weather weather) {
  switch (weather) {
    case render::Weather::overcast:
      return 8000;
    case render::Weather::fog:
      return 800;
    case render::Weather::rain:
      return 3000;
    case render::Weather::clear:
      break;
  }
  return 3500;
}

}  // namespace

EnvironmentSpec read_environment(const json& value, std::vector<Problem>& problems) {
  EnvironmentSpec spec;
  for (const Field& field : fields()) {
    const auto found = value.find(field.name);
    if (found == value.end()) continue;
    spec.*field.value =
        Distribution::read(*found, field.quantity, pointer_of(field.name), problems);
  }
  if (const auto found = value.find("visibility_m"); found != value.end()) {
    spec.visibility_m =
        Distribution::read(*found, visibility_quantity(), pointer_of("visibility_m"), problems);
  }
  if (const auto found = value.find("wind"); found != value.end()) {
    spec.wind = read_wind(*found, problems);
  }
  return spec;
}

json to_json(const EnvironmentSpec& spec) {
  json value;
  for (const Field& field : fields()) {
    value[field.name] = (spec.*field.value).to_json(field.quantity);
  }
  value["wind"] = to_json(spec.wind);
  if (spec.visibility_m) value["visibility_m"] = spec.visibility_m->to_json(visibility_quantity());
  return value;
}

RunEnvironment environment_of_run(const EnvironmentSpec& spec, std::uint64_t run_seed) {
  const auto draw = [&](const Distribution& distribution, const char* name) {
    return distribution.draw(run_seed, pointer_of(name));
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

Sun sun_at(double time_of_day_h, double latitude_deg, int day_of_year) {
  constexpr double kNoon_h = 12;
  constexpr double kTurnPerHour = 15 * kDegree;
  const double day = 360 * kDegree * (day_of_year - 1) / kDaysPerYear;
  const double declination = 0.006918 - 0.399912 * std::cos(day) + 0.070257 * std::sin(day) -
                             0.006758 * std::cos(2 * day) + 0.000907 * std::sin(2 * day) -
                             0.002697 * std::cos(3 * day) + 0.00148 * std::sin(3 * day);
  const double latitude = latitude_deg * kDegree;
  const double hour_angle = (time_of_day_h - kNoon_h) * kTurnPerHour;
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double north = std::cos(latitude) * std::sin(declination) -
                       std::sin(latitude) * std::cos(declination) * std::cos(hour_angle);
  const double up = std::sin(latitude) * std::sin(declination) +
                    std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
  return {std::atan2(north, east), std::asin(std::clamp(up, -1.0, 1.0))};
}

}  // namespace throng::jobs
