// Documents that break the job schema, and what is left of them without the mistakes.
#include "spec/job/schema_problems.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace throng::jobs {
namespace {

using nlohmann::json;

json part_left(const char* text) {
  const SchemaProblems found(json::parse(text), "");
  return found.valid_part() == nullptr ? json() : *found.valid_part();
}

TEST(SchemaProblems, AValidDocumentStays) {
  const char* text = R"({"scenario": "yard", "runs": 2})";
  EXPECT_TRUE(SchemaProblems(json::parse(text), "").problems().empty());
  EXPECT_EQ(part_left(text), json::parse(text));
}

TEST(SchemaProblems, BadMembersGo) {
  EXPECT_EQ(
      part_left(
          R"({"scenario": "yard", "runs": 0, "drone": [], "capture": {"to_s": "x", "rate_hz": 2}})"),
      json::parse(R"({"scenario": "yard", "capture": {"rate_hz": 2}})"));
}

TEST(SchemaProblems, AnArrayGoesWithABadElement) {
  EXPECT_EQ(part_left(R"({"scenario": "yard", "drones": [{"id": "a"}, 7]})"),
            json::parse(R"({"scenario": "yard"})"));
  EXPECT_EQ(part_left(R"({"scenario": "yard", "drones": [{"idd": "a"}]})"),
            json::parse(R"({"scenario": "yard"})"));
}

TEST(SchemaProblems, DeprecatedNamesAreWarnedOf) {
  const std::vector<Problem> warnings =
      deprecated_fields(json::parse(R"({"scenario": "yard", "drones": [{"id": "a"},
          {"id": "b", "guidance": {"policy": "orbit", "centre": [4, 5]}}]})"));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].where, "/drones/1/guidance/centre");
  EXPECT_EQ(warnings[0].found, "the deprecated name \"centre\"");
  EXPECT_EQ(warnings[0].expected, R"("center")");
}

TEST(SchemaProblems, NothingIsLeftWithoutAScenario) {
  EXPECT_TRUE(part_left(R"({"runs": 2})").is_null());
  EXPECT_TRUE(part_left(R"({"scenario": 3})").is_null());
  EXPECT_TRUE(part_left("[]").is_null());
}

TEST(SchemaProblems, ProblemsAtAndBesideARemovedValueFollowFromIt) {
  const SchemaProblems found(
      json::parse(R"({"scenario": "yard", "runs": 0, "capture": {"to_s": "x"}})"), "");
  EXPECT_TRUE(found.may_cause({"", "/runs", "", ""}));
  EXPECT_TRUE(found.may_cause({"", "/capture/to_s", "", ""}));
  EXPECT_TRUE(found.may_cause({"", "/capture/from_s", "", ""}));
  EXPECT_FALSE(found.may_cause({"", "/scenario", "", ""}));
  EXPECT_FALSE(found.may_cause({"", "/outputs/formats/0", "", ""}));
}

}  // namespace
}  // namespace throng::jobs
