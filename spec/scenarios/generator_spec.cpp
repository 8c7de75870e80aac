#include "spec/scenarios/generator_spec.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "base/json/field_table.h"

namespace throng::scenarios {

using nlohmann::json;

namespace {

/// Left out when printed as long as it is 0: sampled.
template <typename Number>
void add_sampled_number(fields::FieldTable<GeneratorSpec>& table, const char* path,
                        const char* title, const char* unit, fields::Values values,
                        Number GeneratorSpec::*member, const char* help) {
  table.add(
      path, title, unit, std::move(values),
      [member](const GeneratorSpec& spec) {
        return spec.*member > 0 ? json(spec.*member) : json();
      },
      [member](GeneratorSpec& spec, const json& value, const fields::FieldLocation& /*place*/) {
        value.get_to(spec.*member);
      },
      help);
}

fields::FieldTable<GeneratorSpec> make_generator_fields() {
  using fields::at;
  using fields::integers;
  using fields::numbers;
  fields::FieldTable<GeneratorSpec> table;
  fields::Values kinds = fields::one_of_words(kPlaceKinds);
  kinds.expected = "plaza, street, campus or block";
  table
      .add("kind", "Kind", "", std::move(kinds), at(&GeneratorSpec::kind),
           "Layout of the scenario.")
      .required();
  table.add("seed", "Seed", "", integers(0, kMaxSeed), at(&GeneratorSpec::seed),
            "Seed of all that is not given.");
  add_sampled_number(table, "size_m", "Size", "m", numbers(30, 200), &GeneratorSpec::size_m,
                     "Length of the longer side.");
  add_sampled_number(table, "exits", "Exits", "", integers(2, 8), &GeneratorSpec::exits,
                     "Number of exits.");
  add_sampled_number(table, "exit_width_m", "Width of exits", "m", numbers(2, 12),
                     &GeneratorSpec::exit_width_m, "Width of each exit.");
  table.add("building_density", "Density of buildings", "", numbers(0, 1),
            at(&GeneratorSpec::building_density), "Share of the building sites that are built up.");
  table.add("clutter", "Clutter", "", numbers(0, 1), at(&GeneratorSpec::clutter),
            "Density of props.");
  table.add("demand_per_minute", "Demand", "people/min", numbers(0.1, 600),
            at(&GeneratorSpec::demand_per_minute), "People who come in by each exit.");
  add_sampled_number(table, "people", "People", "people", integers(1, 5000), &GeneratorSpec::people,
                     "People present at the start.");
  return table;
}

const fields::FieldTable<GeneratorSpec>& generator_fields() {
  static const fields::FieldTable<GeneratorSpec> table = make_generator_fields();
  return table;
}

}  // namespace

GeneratorSpec read_generator_spec(const json& value, const std::string& where,
                                  std::vector<Problem>& problems) {
  GeneratorSpec spec;
  const std::string no_source;
  generator_fields().read_checked(value, spec, {where, no_source, problems});
  return spec;
}

json to_json(const GeneratorSpec& spec) { return generator_fields().print(spec); }

std::string generated_name(const GeneratorSpec& spec) {
  // FNV-1a (Fowler, Noll, Vo): only to tell specs apart.
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : to_json(spec).dump()) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return fmt::format("{}_{}_{:08x}", spec.kind, spec.seed, hash & 0xFFFFFFFFU);
}

std::string generated_scenario_id(const GeneratorSpec& spec) {
  return "generated/" + generated_name(spec);
}

}  // namespace throng::scenarios
