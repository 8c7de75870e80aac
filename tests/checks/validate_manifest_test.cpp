// Validation of datasets whose manifest has values that throng does not write: they are refused, or
// a finding, and never an exception of the JSON library.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "checks/validate.h"
#include "tests/formats/dataset_fixture.h"

namespace throng::checks {
namespace {

using nlohmann::json;

class ValidateManifest : public formats::SmallDataset {
 protected:
  /// "" if the dataset was validated, else the message.
  std::string outcome_with(const std::string& pointer, const json& value) {
    write_manifest();
    json manifest = json::parse(read_file(root_ / "manifest.json"));
    manifest[json::json_pointer(pointer)] = value;
    write_file_atomically(root_ / "manifest.json", manifest.dump());
    try {
      validate_dataset(root_);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
};

TEST_F(ValidateManifest, ValuesOfOtherTypesAreRefusedByName) {
  const std::pair<const char*, json> changes[] = {{"/files", "x"},
                                                  {"/files/1", nullptr},
                                                  {"/files/2/path", json::object()},
                                                  {"/job", json::object()},
                                                  {"/job/outputs", 3},
                                                  {"/job/outputs/classes", {{"by", 7}}},
                                                  {"/job/outputs/splits", {{"train", "most"}}},
                                                  {"/runs", 1}};
  for (const auto& [pointer, value] : changes) {
    EXPECT_THAT(outcome_with(pointer, value), ::testing::HasSubstr("manifest.json"))
        << pointer << " " << value;
  }
}

TEST_F(ValidateManifest, OtherValuesOfTheJobAreNoReasonToFail) {
  const std::pair<const char*, json> changes[] = {{"/job/drones", "two"},
                                                  {"/job/drones", json::array({1, 2})},
                                                  {"/job/environment", json::array({"fog"})},
                                                  {"/job/environment", {{"wind", 3}}},
                                                  {"/files/1/bytes", "many"}};
  for (const auto& [pointer, value] : changes) {
    EXPECT_EQ(outcome_with(pointer, value), "") << pointer << " " << value;
  }
}

}  // namespace
}  // namespace throng::checks
