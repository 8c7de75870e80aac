#include "jobs/spec/wind_spec.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angle.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

using Words = std::array<const char*, 3>;
constexpr Words kProfiles{"uniform", "log", "power"};
constexpr Words kGusts{"none", "dryden", "ou"};

Quantity word_quantity(const Words& words) {
  return {fmt::format(R"(one of "{}", "{}", "{}")", words[0], words[1], words[2]),
          [words](const json& value) -> std::optional<double> {
            const auto* found = std::find(words.begin(), words.end(), value);
            if (found == words.end()) return std::nullopt;
            return static_cast<double>(found - words.begin());
          },
          [words](double index) { return json(words.at(static_cast<std::size_t>(index))); },
          0,
          words.size() - 1.0,
          false};
}

/// A field of the job: its name, how it writes values, and where it is kept.
struct WindField {
  const char* name;
  Quantity quantity;
  Distribution WindFields::*value;
};

const std::array<WindField, 9>& wind_fields() {
  static const std::array<WindField, 9> list = {
      {{"speed_mps", number_quantity(0, 40), &WindFields::speed_mps},
       {"direction_deg", number_quantity(-180, 360), &WindFields::direction_deg},
       {"profile", word_quantity(kProfiles), &WindFields::profile},
       {"roughness_m", number_quantity(1e-4, 3), &WindFields::roughness_m},
       {"exponent", number_quantity(0, 1), &WindFields::exponent},
       {"gusts", word_quantity(kGusts), &WindFields::gusts},
       {"intensity", number_quantity(0, 5), &WindFields::intensity},
       {"gust_mps", number_quantity(0, 15), &WindFields::gust_mps},
       {"gust_time_s", number_quantity(0.1, 60), &WindFields::gust_time_s}}};
  return list;
}

std::string wind_pointer(const char* name) { return fmt::format("/environment/wind/{}", name); }

}  // namespace

WindFields read_wind(const json& value, std::vector<Problem>& problems) {
  WindFields fields;
  for (const WindField& field : wind_fields()) {
    const auto found = value.find(field.name);
    if (found == value.end()) continue;
    fields.*field.value =
        Distribution::read(*found, field.quantity, wind_pointer(field.name), problems);
  }
  return fields;
}

json to_json(const WindFields& fields) {
  json value;
  for (const WindField& field : wind_fields()) {
    value[field.name] = (fields.*field.value).to_json(field.quantity);
  }
  return value;
}

sim::WindSpec wind_of_run(const WindFields& fields, std::uint64_t run_seed) {
  const auto draw = [&](Distribution WindFields::*member) {
    const auto& list = wind_fields();
    const auto* field = std::find_if(list.begin(), list.end(),
                                     [&](const WindField& entry) { return entry.value == member; });
    return (fields.*member).draw(run_seed, wind_pointer(field->name));
  };
  sim::WindSpec wind;
  wind.speed_mps = draw(&WindFields::speed_mps);
  wind.direction_rad = draw(&WindFields::direction_deg) * kDegree;
  wind.profile = static_cast<sim::WindProfile>(draw(&WindFields::profile));
  wind.roughness_m = draw(&WindFields::roughness_m);
  wind.exponent = draw(&WindFields::exponent);
  wind.gusts = static_cast<sim::GustModel>(draw(&WindFields::gusts));
  wind.intensity = draw(&WindFields::intensity);
  wind.gust_mps = draw(&WindFields::gust_mps);
  wind.gust_time_s = draw(&WindFields::gust_time_s);
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
