#include "base/schemas/schemas.h"

#include "base/json/json_text.h"

namespace throng::embedded {
extern const std::string_view kScenarioSchema;
extern const std::string_view kBlueprintSchema;
extern const std::string_view kExperimentsSchema;
}  // namespace throng::embedded

namespace throng::schemas {

namespace {

template <Kind kind>
const JsonSchema& compiled() {
  static const Entry& entry = entries().at(static_cast<std::size_t>(kind));
  static const JsonSchema schema(parse_json(entry.text, std::string(entry.name)));
  return schema;
}

}  // namespace

const std::array<Entry, 3>& entries() {
  static const std::array<Entry, 3> all = {{
      {Kind::scenario, "scenario", embedded::kScenarioSchema},
      {Kind::blueprint, "blueprint", embedded::kBlueprintSchema},
      {Kind::experiments, "experiments", embedded::kExperimentsSchema},
  }};
  return all;
}

const JsonSchema& schema_for(Kind kind) {
  switch (kind) {
    case Kind::scenario:
      return compiled<Kind::scenario>();
    case Kind::blueprint:
      return compiled<Kind::blueprint>();
    case Kind::experiments:
      break;
  }
  return compiled<Kind::experiments>();
}

void add_schema_problems(Kind kind, const nlohmann::json& document, const std::string& source,
                         std::vector<Problem>& problems) {
  add_other_places(problems, schema_for(kind).problems(document, source));
}

}  // namespace throng::schemas
