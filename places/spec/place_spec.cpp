#include "places/spec/place_spec.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/suggest.h"

namespace throng::places {

using nlohmann::json;

namespace {

void read_number(const json& value, const char* key, double low, double high,
                 const std::string& where, std::vector<Problem>& problems, double& number) {
  if (!value.contains(key)) return;
  const json& found = value[key];
  if (!found.is_number() || found < low || found > high) {
    problems.push_back({"", where + "/" + key, found.dump(),
                        fmt::format("a number from {:g} to {:g}", low, high)});
    return;
  }
  found.get_to(number);
}

void read_integer(const json& value, const char* key, int low, int high, const std::string& where,
                  std::vector<Problem>& problems, int& number) {
  if (!value.contains(key)) return;
  const json& found = value[key];
  if (!found.is_number_integer() || found < low || found > high) {
    problems.push_back(
        {"", where + "/" + key, found.dump(), fmt::format("an integer from {} to {}", low, high)});
    return;
  }
  found.get_to(number);
}

}  // namespace

PlaceSpec read_place_spec(const json& value, const std::string& where,
                          std::vector<Problem>& problems) {
  PlaceSpec spec;
  if (!value.is_object()) {
    problems.push_back({"", where, value.dump(), "an object"});
    return spec;
  }
  constexpr std::array<std::string_view, 9> kFields = {"kind",         "seed",
                                                       "size_m",       "exits",
                                                       "exit_width_m", "building_density",
                                                       "clutter",      "demand_per_minute",
                                                       "people"};
  for (const auto& [key, field] : value.items()) {
    if (std::find(kFields.begin(), kFields.end(), key) != kFields.end()) continue;
    problems.push_back(unknown_name("", where + "/" + key, "field", key, kFields));
  }
  const json kind = value.value("kind", json());
  const auto* const known = std::find(kPlaceKinds.begin(), kPlaceKinds.end(),
                                      kind.is_string() ? kind.get<std::string>() : "");
  if (known == kPlaceKinds.end()) {
    problems.push_back({"", where + "/kind", kind.dump(), "plaza, street, campus or block"});
  } else {
    spec.kind = *known;
  }
  int seed = 1;
  read_integer(value, "seed", 0, 1'000'000'000, where, problems, seed);
  spec.seed = static_cast<std::uint64_t>(seed);
  read_number(value, "size_m", 30, 200, where, problems, spec.size_m);
  read_integer(value, "exits", 2, 8, where, problems, spec.exits);
  read_number(value, "exit_width_m", 2, 12, where, problems, spec.exit_width_m);
  read_number(value, "building_density", 0, 1, where, problems, spec.building_density);
  read_number(value, "clutter", 0, 1, where, problems, spec.clutter);
  read_number(value, "demand_per_minute", 0.1, 600, where, problems, spec.demand_per_minute);
  read_integer(value, "people", 1, 5000, where, problems, spec.people);
  return spec;
}

json to_json(const PlaceSpec& spec) {
  json value = {{"kind", spec.kind},
                {"seed", spec.seed},
                {"building_density", spec.building_density},
                {"clutter", spec.clutter},
                {"demand_per_minute", spec.demand_per_minute}};
  if (spec.size_m > 0) value["size_m"] = spec.size_m;
  if (spec.exits > 0) value["exits"] = spec.exits;
  if (spec.exit_width_m > 0) value["exit_width_m"] = spec.exit_width_m;
  if (spec.people > 0) value["people"] = spec.people;
  return value;
}

std::string id_of(const PlaceSpec& spec) {
  // FNV-1a (Fowler, Noll, Vo): only to tell specs apart.
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : to_json(spec).dump()) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return fmt::format("{}_{}_{:08x}", spec.kind, spec.seed, hash & 0xFFFFFFFFU);
}

}  // namespace throng::places
