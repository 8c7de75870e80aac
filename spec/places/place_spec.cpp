#include "spec/places/place_spec.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "base/json/field_table.h"

namespace throng::places {

using nlohmann::json;

namespace {

/// Left out when printed as long as it is 0: sampled.
template <typename Number>
void add_sampled_number(fields::FieldTable<PlaceSpec>& table, const char* path, const char* title,
                        const char* unit, fields::Values values, Number PlaceSpec::*member,
                        const char* help) {
  table.add(
      path, title, unit, std::move(values),
      [member](const PlaceSpec& spec) { return spec.*member > 0 ? json(spec.*member) : json(); },
      [member](PlaceSpec& spec, const json& value, const fields::FieldPlace& /*place*/) {
        value.get_to(spec.*member);
      },
      help);
}

fields::FieldTable<PlaceSpec> make_place_fields() {
  using fields::at;
  using fields::integers;
  using fields::numbers;
  fields::FieldTable<PlaceSpec> table;
  fields::Values kinds = fields::one_of(kPlaceKinds);
  kinds.expected = "plaza, street, campus or block";
  table.add("kind", "Kind", "", std::move(kinds), at(&PlaceSpec::kind), "Layout of the place.")
      .required();
  table.add("seed", "Seed", "", integers(0, 1'000'000'000), at(&PlaceSpec::seed),
            "Seed of all that is not given.");
  add_sampled_number(table, "size_m", "Size", "m", numbers(30, 200), &PlaceSpec::size_m,
                     "Length of the longer side.");
  add_sampled_number(table, "exits", "Exits", "", integers(2, 8), &PlaceSpec::exits,
                     "Number of exits.");
  add_sampled_number(table, "exit_width_m", "Width of exits", "m", numbers(2, 12),
                     &PlaceSpec::exit_width_m, "Width of each exit.");
  table.add("building_density", "Density of buildings", "", numbers(0, 1),
            at(&PlaceSpec::building_density), "Share of the building sites that are built up.");
  table.add("clutter", "Clutter", "", numbers(0, 1), at(&PlaceSpec::clutter), "Density of props.");
  table.add("demand_per_minute", "Demand", "people/min", numbers(0.1, 600),
            at(&PlaceSpec::demand_per_minute), "People who come in by each exit.");
  add_sampled_number(table, "people", "People", "people", integers(1, 5000), &PlaceSpec::people,
                     "People present at the start.");
  return table;
}

const fields::FieldTable<PlaceSpec>& place_fields() {
  static const fields::FieldTable<PlaceSpec> table = make_place_fields();
  return table;
}

}  // namespace

PlaceSpec read_place_spec(const json& value, const std::string& where,
                          std::vector<Problem>& problems) {
  PlaceSpec spec;
  const std::string no_source;
  place_fields().read_checked(value, spec, {where, no_source, problems});
  return spec;
}

json to_json(const PlaceSpec& spec) { return place_fields().print(spec); }

std::string id_of(const PlaceSpec& spec) {
  // FNV-1a (Fowler, Noll, Vo): only to tell specs apart.
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : to_json(spec).dump()) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return fmt::format("{}_{}_{:08x}", spec.kind, spec.seed, hash & 0xFFFFFFFFU);
}

std::string scenario_id_of(const PlaceSpec& spec) { return "generated/" + id_of(spec); }

}  // namespace throng::places
