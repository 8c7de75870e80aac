#include "spec/job/wind_spec.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/geometry/angle.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

using Words = std::array<const char*, 3>;
constexpr Words kProfiles{"uniform", "log", "power"};
constexpr Words kGusts{"none", "dryden", "ou"};

std::string wind_pointer(const char* name) { return fmt::format("/environment/wind/{}", name); }

}  // namespace

const FieldTable<WindFields>& wind_fields() {
  static const FieldTable<WindFields> fields = [] {
    FieldTable<WindFields> table;
    add_sampled(table, "speed_mps", "Wind", "m/s", numbers(0, 40), at(&WindFields::speed_mps),
                "Mean wind 10 m above the ground.");
    add_sampled(table, "direction_deg", "Wind's direction", "degrees", numbers(-180, 360),
                at(&WindFields::direction_deg),
                "Direction that the wind blows to, counterclockwise from +x (east).");
    add_sampled(table, "profile", "Profile", "", sampled_words(kProfiles), at(&WindFields::profile),
                "Mean wind over height: log (grows with the logarithm of height over "
                "roughness), power (with a power of height), uniform (constant).");
    add_sampled(table, "roughness_m", "Roughness", "m", numbers(0.0001, 3),
                at(&WindFields::roughness_m),
                "Roughness length of the ground, for the profile log: 0.03 grass, 0.4 suburbs, "
                "1 and more cities.");
    add_sampled(table, "exponent", "Exponent", "", numbers(0, 1), at(&WindFields::exponent),
                "Exponent of the profile power.");
    add_sampled(table, "gusts", "Gusts", "", sampled_words(kGusts), at(&WindFields::gusts),
                "Gust model of each drone: dryden (turbulence of MIL-F-8785C at low altitude, "
                "which follows from wind and height), ou (Ornstein-Uhlenbeck, of a given "
                "strength and duration), none.");
    add_sampled(table, "intensity", "Intensity", "", numbers(0, 5), at(&WindFields::intensity),
                "Factor on the strength of dryden's gusts.");
    add_sampled(table, "gust_mps", "Strength of gusts", "m/s", numbers(0, 15),
                at(&WindFields::gust_mps), "Standard deviation of ou's gusts along each axis.");
    add_sampled(table, "gust_time_s", "Duration of gusts", "s", numbers(0.1, 60),
                at(&WindFields::gust_time_s), "Correlation time of ou's gusts.");
    return table;
  }();
  return fields;
}

sim::WindSpec wind_of_run(const WindFields& fields, std::uint64_t run_seed) {
  const auto draw = [&](const Distribution& distribution, const char* name) {
    return distribution.draw(run_seed, wind_pointer(name));
  };
  sim::WindSpec wind;
  wind.speed_mps = draw(fields.speed_mps, "speed_mps");
  wind.direction_rad = draw(fields.direction_deg, "direction_deg") * kDegree;
  wind.profile = static_cast<sim::WindProfile>(draw(fields.profile, "profile"));
  wind.roughness_m = draw(fields.roughness_m, "roughness_m");
  wind.exponent = draw(fields.exponent, "exponent");
  wind.gusts = static_cast<sim::GustModel>(draw(fields.gusts, "gusts"));
  wind.intensity = draw(fields.intensity, "intensity");
  wind.gust_mps = draw(fields.gust_mps, "gust_mps");
  wind.gust_time_s = draw(fields.gust_time_s, "gust_time_s");
  return wind;
}

json to_json(const sim::WindSpec& wind) {
  constexpr double kDigits = 1e9;  // more are those of the conversion
  json record = {{"speed_mps", wind.speed_mps},
                 {"direction_deg", std::round(wind.direction_rad / kDegree * kDigits) / kDigits},
                 {"profile", kProfiles.at(static_cast<std::size_t>(wind.profile))},
                 {"gusts", kGusts.at(static_cast<std::size_t>(wind.gusts))}};
  if (wind.profile == sim::WindProfile::log_law) record["roughness_m"] = wind.roughness_m;
  if (wind.profile == sim::WindProfile::power_law) record["exponent"] = wind.exponent;
  if (wind.gusts == sim::GustModel::dryden) record["intensity"] = wind.intensity;
  if (wind.gusts == sim::GustModel::ou) {
    record["gust_mps"] = wind.gust_mps;
    record["gust_time_s"] = wind.gust_time_s;
  }
  return record;
}

}  // namespace throng::jobs
