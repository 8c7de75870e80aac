// Deeply nested JSON in every place of the API that takes JSON: each is refused, and the service
// lives on.
#include <gmock/gmock.h>

#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;

using HostileJson = ApiTest;

std::string nested(std::size_t depth, const std::string& open, const std::string& close) {
  std::string text;
  for (std::size_t i = 0; i < depth; ++i) text += open;
  text += "1";
  for (std::size_t i = 0; i < depth; ++i) text += close;
  return text;
}

std::vector<std::string> hostile_values() {
  return {nested(150'000, "[", "]"),
          nested(90'000, "{\"a\":", "}"),
          nested(65, "[", "]"),
          "1e999",
          "NaN",
          "\"\xff\"",
          "\"\\ud800\"",
          R"({"a": 1, "a": 2})"};
}

TEST_F(HostileJson, IsRefusedEverywhere) {
  const std::string job = submit_and_wait();
  const std::string self = "/v1/jobs/" + job;
  const std::string bundle = "--B\r\nContent-Disposition: form-data; name=\"job\"\r\n\r\n";
  const std::string tail =
      "\r\n--B\r\nContent-Disposition: form-data; name=\"scenario\"\r\n\r\nPK\r\n--B--\r\n";
  for (const std::string& value : hostile_values()) {
    SCOPED_TRACE(value.substr(0, 40));
    for (const std::string& body :
         {value, R"({"scenario": "yard", "randomize": )" + value + "}",
          R"({"scenario": "yard", "name": )" + value + "}",
          R"({"scenario": "yard", "drones": [{"camera": {"calibration": )" + value + "}}]}",
          R"({"scenario": )" + value + "}", R"({"labels": )" + value + "}",
          R"({"priority": )" + value + "}", R"({"keep": )" + value + "}", R"({"x": )" + value + "}",
          R"({"files": )" + value + "}", R"({"files": {"a": )" + value + "}}",
          R"({"url": )" + value + "}", R"({"url": "http://a", "events": )" + value + "}",
          R"({"enabled": )" + value + "}"}) {
      for (const char* path :
           {"/v1/jobs", "/v1/jobs?dry_run", "/v1/calibrations", "/v1/webhooks"}) {
        const auto answer = client().Post(path, body, "application/json");
        ASSERT_TRUE(answer) << path << " " << body.substr(0, 80);
        EXPECT_EQ(answer->status, 400) << path << " " << body.substr(0, 80);
        EXPECT_LT(answer->body.size(), 5000U);
      }
      EXPECT_EQ(client().Post(self + "/clone", body, "application/json")->status, 400);
      EXPECT_EQ(client().Patch(self, body, "application/json")->status, 400);
      for (const char* path : {"/v1/jobs", "/v1/jobs?dry_run", "/v1/calibrations"}) {
        EXPECT_EQ(
            client().Post(path, bundle + body + tail, "multipart/form-data; boundary=B")->status,
            400)
            << path << " " << body.substr(0, 80);
      }
    }
  }
  EXPECT_EQ(get("/healthz")->status, 200);
  EXPECT_EQ(get_json("/v1/jobs")["jobs"].size(), 1U) << "nothing was queued";
}

TEST_F(HostileJson, NothingFollowsAZeroByte) {
  const std::string body = std::string(kJob) + std::string("\0", 1) + R"({"scenario": "other"})";
  for (const char* path : {"/v1/jobs", "/v1/jobs?dry_run", "/v1/calibrations", "/v1/webhooks"}) {
    expect_problem(client().Post(path, body, "application/json"), 400);
  }
  EXPECT_TRUE(get_json("/v1/jobs")["jobs"].empty());
}

TEST_F(HostileJson, BytesThatAreNoTextAreRefusedInLabels) {
  expect_problem(client().Post("/v1/jobs?label=%ff", kJob, "application/json"), 400);
  EXPECT_EQ(get("/v1/jobs?label=%ff")->status, 200);
  EXPECT_TRUE(get_json("/v1/jobs")["jobs"].empty());
}

TEST_F(HostileJson, NamesTooLongForAFileAreUnknown) {
  const std::string self = "/v1/jobs/" + submit_and_wait();
  const std::string name(300, 'x');
  expect_problem(get(self + "/logs/" + name), 404);
  expect_problem(get(self + "/files/" + name), 404);
  expect_problem(get(self + "/previews/" + name), 404);
  expect_problem(get("/v1/scenarios/" + name), 404);
  const httplib::MultipartFormDataItems items = {{"request", "{}", "", "application/json"},
                                                 {"file", "x", name, "text/csv"}};
  expect_problem(client().Post("/v1/calibrations", items), 400);
}

TEST_F(HostileJson, ManySmallValuesAreRefused) {
  std::string many = "[1";
  for (int i = 0; i < 500'000; ++i) many += ",1";
  many += "]";
  const auto answer =
      client().Post("/v1/webhooks", "{\"events\": " + many + "}", "application/json");
  EXPECT_EQ(answer->status, 400);
  EXPECT_THAT(answer->body, HasSubstr("values"));
}

}  // namespace
}  // namespace throng::server
