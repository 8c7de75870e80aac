#include "server/description/value_type.h"

#include <gtest/gtest.h>

namespace throng::server {
namespace {

using nlohmann::json;

json of(const ValueType& type) { return json(type.schema()); }

TEST(ValueTypes, TextsAreSchemas) {
  EXPECT_EQ(of("string"), json::parse(R"({"type": "string"})"));
  EXPECT_EQ(of("any"), json::object());
  EXPECT_EQ(of("time"), json::parse(R"({"type": "string", "format": "date-time"})"));
  EXPECT_EQ(of("Job"), json::parse(R"({"$ref": "#/components/schemas/Job"})"));
  EXPECT_EQ(of("number?"), json::parse(R"({"type": ["number", "null"]})"));
  EXPECT_EQ(of("Job?"),
            json::parse(R"({"oneOf": [{"type": "null"}, {"$ref": "#/components/schemas/Job"}]})"));
  EXPECT_EQ(of("integer[][]"), json::parse(R"({"type": "array",
    "items": {"type": "array", "items": {"type": "integer"}}})"));
  EXPECT_EQ(of("number?[2]"), json::parse(R"({"type": "array",
    "items": {"type": ["number", "null"]}, "minItems": 2, "maxItems": 2})"));
}

TEST(ValueTypes, MembersAreRequiredUnlessTheyMayBeLeftOut) {
  const ValueType type = closed({{"id", "string"}, {"bytes?", "integer", "Size of the file."}});
  EXPECT_EQ(of(type), json::parse(R"({"type": "object", "required": ["id"], "properties": {
    "id": {"type": "string"}, "bytes": {"type": "integer", "description": "Size of the file."}},
    "additionalProperties": false})"));
  EXPECT_EQ(of(object({})), json::parse(R"({"type": "object", "properties": {}})"));
}

}  // namespace
}  // namespace throng::server
