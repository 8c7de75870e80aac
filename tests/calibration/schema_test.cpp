// The schema of a request and the reader accept the same input.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/error.h"
#include "calibration/request.h"

namespace throng::calibrate {
namespace {

using nlohmann::json;

bool schema_takes(const json& request) {
  const json document = json(request_schema());
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(document),
                                          schema);
  return valijson::Validator(valijson::Validator::kStrongTypes)
      .validate(schema, valijson::adapters::NlohmannJsonAdapter(request), nullptr);
}

bool reader_takes(const json& request) {
  try {
    request_from_json(request, "/");
    return true;
  } catch (const InputError& error) {
    // Files, and what belongs together, are not the schema's.
    const Problem& problem = error.problems().front();
    return problem.found == "nothing of the kind";
  }
}

TEST(RequestSchema, AcceptsTheSameDocumentsAsTheReader) {
  for (const char* text :
       {R"({})", R"({"kind": "pose", "name": "roof"})", R"({"kind": "bundle", "fix_lens": true})",
        R"({"board": {"kind": "charuco", "columns": 7, "rows": 5, "square": 0.04, "marker": 0.03,
            "dictionary": "5X5_50"}})",
        R"({"lens": "auto"})", R"({"lens": "fisheye", "skew": true, "size": "640x480"})",
        R"({"fix": {"k3": 0, "cx": null}, "tie": {"fx": {"to": "fy", "ratio": 1}},
            "prior": {"cx": {"mean": 640, "sd": 20}}})",
        R"({"reject": false, "outlier_px": 3, "loss_px": 1.5, "sigma_px": 0.4})"}) {
    EXPECT_TRUE(schema_takes(json::parse(text))) << text;
    EXPECT_TRUE(reader_takes(json::parse(text))) << text;
  }
}

TEST(RequestSchema, RefusesTheSameDocumentsAsTheReader) {
  for (const char* text : {R"([])",
                           R"({"colour": 1})",
                           R"({"kind": "guess"})",
                           R"({"name": 1})",
                           R"({"images": "a.jpg"})",
                           R"({"board": []})",
                           R"({"board": {"kind": "round"}})",
                           R"({"board": {"columns": 1.5}})",
                           R"({"board": {"rows": 2}})",
                           R"({"board": {"square": 0}})",
                           R"({"board": {"kind": "charuco", "dictionary": "9X9"}})",
                           R"({"lens": "bent"})",
                           R"({"skew": 1})",
                           R"({"size": "wide"})",
                           R"({"fix": {"k1": "a"}})",
                           R"({"tie": {"fx": 1}})",
                           R"({"prior": {"cx": 1}})",
                           R"({"sigma_px": 0})",
                           R"({"reject": "no"})",
                           R"({"points": 1})"}) {
    EXPECT_FALSE(schema_takes(json::parse(text))) << text;
    EXPECT_FALSE(reader_takes(json::parse(text))) << text;
  }
}

}  // namespace
}  // namespace throng::calibrate
