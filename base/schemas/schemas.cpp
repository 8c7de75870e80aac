#include "base/schemas/schemas.h"

#include "base/json/json_text.h"

namespace throng::embedded {
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

const std::array<Entry, 1>& entries() {
  static const std::array<Entry, 1> all = {{
      {Kind::experiments, "experiments", embedded::kExperimentsSchema},
  }};
  return all;
}

const JsonSchema& schema_for(Kind kind) {
  check(kind == Kind::experiments, "the only kind");
  return compiled<Kind::experiments>();
}

void add_schema_problems(Kind kind, const nlohmann::json& document, const std::string& source,
                         std::vector<Problem>& problems) {
  add_other_places(problems, schema_for(kind).problems(document, source));
}

}  // namespace throng::schemas
