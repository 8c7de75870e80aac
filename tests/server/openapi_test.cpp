// The document that describes the API, against its routes and its answers.
#include <gmock/gmock.h>

#include <regex>
#include <set>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "base/files/files.h"
#include "server/routes/route_table.h"
#include "tests/server/api_fixture.h"
#include "tests/server/bundles.h"

namespace throng::server {
namespace {

class OpenApi : public ApiTest {
 protected:
  OpenApi() : document_(get_json("/openapi.json")) {}

  const json& operation(const std::string& method, const std::string& path) const {
    return document_["paths"][path][method];
  }

  /// Whether the answer is one that the operation may give, and its body matches the schema.
  void expect_described(const std::string& method, const std::string& path,
                        const httplib::Result& answer) {
    SCOPED_TRACE(fmt::format("{} {}: {} {}", method, path, answer->status, answer->body));
    const json& responses = operation(method, path)["responses"];
    const std::string status = std::to_string(answer->status);
    ASSERT_TRUE(responses.contains(status));
    json response = responses[status];
    if (response.contains("$ref")) response = document_["components"]["responses"]["Problem"];
    described_.insert(fmt::format("{} {} {}", method, path, status));
    if (!response.contains("content")) return;
    std::string type = answer->get_header_value("Content-Type");
    type.resize(std::min(type.find(';'), type.size()));
    ASSERT_TRUE(response["content"].contains(type) ||
                response["content"].contains("application/octet-stream"))
        << type;
    const json schema = response["content"].value(type, json::object()).value("schema", json());
    if (schema.is_null()) return;
    expect_valid(schema, type.ends_with("json") ? json::parse(answer->body) : json(answer->body));
  }

  std::set<std::string> described_;

  void expect_webhooks_described() {
    const auto posted = [&](const std::string& path, const std::string& body) {
      return client().Post(path, body, "application/json");
    };
    const auto made = posted("/v1/webhooks", R"({"url": "http://127.0.0.1:1/"})");
    expect_described("post", "/v1/webhooks", made);
    expect_described("post", "/v1/webhooks", posted("/v1/webhooks", "{}"));
    expect_described("get", "/v1/webhooks", get("/v1/webhooks"));
    const std::string hook = json::parse(made->body)["links"]["self"];
    expect_described("post", "/v1/webhooks/{id}/ping", posted(hook + "/ping", ""));
    expect_described("get", "/v1/webhooks/{id}/deliveries", get(hook + "/deliveries"));
    expect_described("get", "/v1/webhooks/{id}", get(hook));
    expect_described("patch", "/v1/webhooks/{id}",
                     client().Patch(hook, R"({"enabled": false})", "application/json"));
    expect_described("delete", "/v1/webhooks/{id}", client().Delete(hook));
    expect_described("get", "/v1/webhooks/{id}", get(hook));
  }

 private:
  void expect_valid(json schema, const json& value) const {
    schema["components"] = document_["components"];
    valijson::Schema parsed;
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema),
                                            parsed);
    valijson::ValidationResults results;
    const bool valid =
        valijson::Validator(valijson::Validator::kStrongTypes)
            .validate(parsed, valijson::adapters::NlohmannJsonAdapter(value), &results);
    std::string reasons;
    for (valijson::ValidationResults::Error error; results.popError(error);) {
      for (const std::string& place : error.context) reasons += place;
      reasons += ": " + error.description + "\n";
    }
    EXPECT_TRUE(valid) << reasons;
  }

  json document_;
};

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

TEST_F(OpenApi, DescribesEveryRouteAndNoOther) {
  std::set<std::string> served;
  for (const Route& route : routes()) {
    served.insert(fmt::format("{} {}", lower(to_string(route.method)), route.path));
  }
  const json document = get_json("/openapi.json");
  EXPECT_EQ(document["openapi"], "3.1.0");
  std::set<std::string> described;
  for (const auto& [path, operations] : document["paths"].items()) {
    for (const auto& [method, operation] : operations.items()) {
      described.insert(fmt::format("{} {}", method, path));
      EXPECT_FALSE(operation["summary"].get<std::string>().empty()) << path;
      // Each parameter in the path, and no other.
      std::set<std::string> named;
      for (const json& parameter : operation.value("parameters", json::array())) {
        if (parameter["in"] == "path") named.insert(parameter["name"]);
      }
      std::set<std::string> in_path;
      static const std::regex kParameter(R"(\{(\w+)\})");
      for (std::sregex_iterator at(path.begin(), path.end(), kParameter), end; at != end; ++at) {
        in_path.insert((*at)[1]);
      }
      EXPECT_EQ(named, in_path) << path;
    }
  }
  EXPECT_EQ(described, served);
}

TEST_F(OpenApi, AnswersAreAsDescribed) {
  const auto posted = [&](const std::string& path, const std::string& body) {
    return client().Post(path, body, "application/json");
  };
  expect_described("post", "/v1/jobs", posted("/v1/jobs", kJob));
  expect_described("post", "/v1/jobs", posted("/v1/jobs?dry_run", kJob));
  expect_described("post", "/v1/jobs", posted("/v1/jobs", R"({"runs": 0})"));
  expect_described("post", "/v1/jobs", client().Post("/v1/jobs", "x", "text/plain"));
  const std::string id = submit_and_wait();
  const std::string self = "/v1/jobs/" + id;
  write_file_atomically(service.folders().dataset_folder(id) / "metrics/run000.json", "{}");
  write_file_atomically(service.folders().dataset_folder(id) / "exits/run000.csv", "frame\n");
  write_file_atomically(service.folders().dataset_folder(id) / "previews/run000/d1/000000.jpg",
                        "image");
  write_file_atomically(service.folders().job_folder(id) / "logs/run000_trace.log", "hello\n");
  for (const auto& [path, tail] : std::map<std::string, std::string>{
           {"/v1/jobs/{id}", ""},
           {"/v1/jobs/{id}/events", "/events"},
           {"/v1/jobs/{id}/report", "/report"},
           {"/v1/jobs/{id}/plan", "/plan"},
           {"/v1/jobs/{id}/logs", "/logs"},
           {"/v1/jobs/{id}/logs/{name}", "/logs/run000_trace.log"},
           {"/v1/jobs/{id}/previews", "/previews"},
           {"/v1/jobs/{id}/previews/{path}", "/previews/run000/d1/000000.jpg"},
           {"/v1/jobs/{id}/archive", "/archive"},
           {"/v1/jobs/{id}/images", "/images"},
           {"/v1/jobs/{id}/manifest", "/manifest"},
           {"/v1/jobs/{id}/files/{path}", "/files/metrics.json"},
           {"/v1/jobs/{id}/metrics", "/metrics"},
           {"/v1/jobs/{id}/runs/{n}/metrics", "/runs/0/metrics"},
           {"/v1/jobs/{id}/runs/{n}/metrics.csv", "/runs/0/metrics.csv"},
           {"/v1/jobs/{id}/runs/{n}/trace", "/runs/0/trace"}}) {
    expect_described("get", path, get(self + tail));
    expect_described("get", path, get("/v1/jobs/jnosuchjob00000" + tail));
  }
  for (const std::string path :
       {"/v1/jobs", "/v1/events", "/v1/calibrations", "/v1/studies", "/v1/scenarios",
        "/v1/airframes", "/v1/policies", "/v1/formats", "/v1/schema", "/v1/version",
        "/openapi.json", "/metrics", "/healthz", "/readyz", "/v1/session"}) {
    expect_described("get", path, get(path));
    EXPECT_EQ(get(path)->status, 200) << path;
  }
  expect_described("get", "/v1/scenarios/{path}", get("/v1/scenarios/yard"));
  expect_described("get", "/v1/scenarios/{path}", get("/v1/scenarios/../../etc/passwd"));
  expect_described("get", "/v1/people", get("/v1/people"));
  for (const char* query : {"?name=mine&dry_run", "?name=mine", "?name=mine", "?name=.."}) {
    expect_described(
        "post", "/v1/scenarios",
        client().Post(fmt::format("/v1/scenarios{}", query), yard_bundle(), "application/zip"));
  }
  expect_described("get", "/v1/scenarios", get("/v1/scenarios"));
  expect_described("get", "/v1/scenarios/{path}", get("/v1/scenarios/mine/yard"));
  expect_described("get", "/v1/scenarios/{path}", get("/v1/scenarios/mine/yard?format=svg"));
  expect_described("delete", "/v1/scenarios/{path}", client().Delete("/v1/scenarios/mine"));
  expect_described("delete", "/v1/scenarios/{path}", client().Delete("/v1/scenarios/mine"));
  expect_described("patch", "/v1/jobs/{id}",
                   client().Patch(self, R"({"priority": 2})", "application/json"));
  expect_described("patch", "/v1/jobs/{id}", client().Patch(self, "[]", "application/json"));
  expect_described("post", "/v1/jobs/{id}/cancel", posted(self + "/cancel", ""));
  expect_described("post", "/v1/jobs/{id}/retry", posted(self + "/retry", ""));
  expect_described("post", "/v1/jobs/{id}/clone", posted(self + "/clone", R"({"seed": 2})"));
  expect_described("delete", "/v1/jobs/{id}", client().Delete(self));
  expect_described("delete", "/v1/jobs/{id}", client().Delete(self));
  expect_webhooks_described();
  expect_described("get", "/v1/live", get("/v1/live"));
  expect_described("post", "/v1/live", posted("/v1/live", "{}"));
  expect_described("post", "/v1/live", posted("/v1/live", R"({"job": {"runs": 0}})"));
  expect_described("post", "/v1/live", posted("/v1/live", R"({"job": {}, "record": 1})"));
  for (const char* path : {"/stream", "/recording", ""}) {
    expect_described("get", std::string("/v1/live/{id}") + path,
                     get(std::string("/v1/live/l0") + path));
  }
  for (const char* path : {"/commands", "/stop"}) {
    expect_described("post", std::string("/v1/live/{id}") + path,
                     posted(std::string("/v1/live/l0") + path, "{}"));
  }
  expect_described("delete", "/v1/live/{id}", client().Delete("/v1/live/l0"));
  expect_described("post", "/v1/session", posted("/v1/session", R"({"key": "any"})"));
  expect_described("post", "/v1/service/drain", posted("/v1/service/drain", ""));
  expect_described("post", "/v1/session", posted("/v1/session", "{}"));
  expect_described("delete", "/v1/session", client().Delete("/v1/session"));
  EXPECT_GT(described_.size(), 45U);
}

TEST_F(OpenApi, DescribesStudies) {
  SKIP_WITHOUT_PROGRAM();
  ::setenv("THRONG_SCENARIOS", service.folders().scenarios().c_str(), 1);
  const auto posted = [&](const std::string& path, const std::string& body) {
    return client().Post(path, body, "application/json");
  };
  const std::string study = R"({"runs": 1, "policies": [{"id": "none"}], "cases": [{"id": "yard",
    "scenario": "yard", "alarm_s": 0, "duration_s": 3}]})";
  expect_described("post", "/v1/studies", posted("/v1/studies?dry_run", study));
  expect_described("post", "/v1/studies", posted("/v1/studies", "{}"));
  const httplib::Result made = posted("/v1/studies", study);
  expect_described("post", "/v1/studies", made);
  const std::string self = made->get_header_value("Location");
  expect_described("get", "/v1/studies/{id}", get(self));
  EXPECT_TRUE(wait_until([&] { return get_json(self)["state"] == "succeeded"; }));
  ::unsetenv("THRONG_SCENARIOS");
  expect_described("get", "/v1/studies/{id}", get(self));
  expect_described("get", "/v1/studies", get("/v1/studies"));
  expect_described("get", "/v1/studies/{id}/report", get(self + "/report"));
  for (const char* file : {"summary.json", "summary.csv", "summary.md", "values.json", "x"}) {
    expect_described("get", "/v1/studies/{id}/files/{path}", get(self + "/files/" + file));
  }
  expect_described("get", "/v1/studies/{id}/events", get(self + "/events"));
  expect_described("patch", "/v1/studies/{id}",
                   client().Patch(self, R"({"keep": true})", "application/json"));
  expect_described("post", "/v1/studies/{id}/cancel", posted(self + "/cancel", ""));
  expect_described("post", "/v1/studies/{id}/retry", posted(self + "/retry", ""));
  expect_described("delete", "/v1/studies/{id}", client().Delete(self));
  expect_described("get", "/v1/studies/{id}", get(self));
  EXPECT_THAT(described_,
              ::testing::IsSupersetOf(
                  {"post /v1/studies 200", "post /v1/studies 201", "get /v1/studies/{id} 200",
                   "get /v1/studies/{id}/report 200", "delete /v1/studies/{id} 204"}));
}

TEST_F(OpenApi, DescribesKeys) {
  const httplib::Headers admin = {{"Authorization", "Bearer " + keys.create("me", Scope::admin)}};
  const auto made = [&](const char* body) {
    return client().Post("/v1/keys", admin, body, "application/json");
  };
  const httplib::Result key = made(R"({"name": "friend", "max_jobs": 3})");
  expect_described("post", "/v1/keys", key);
  expect_described("post", "/v1/keys", made("{}"));
  const std::string path = json::parse(key->body)["links"]["self"];
  for (int time = 0; time < 2; ++time) {
    expect_described("delete", "/v1/keys/{id}", client().Delete(path, admin));
  }
  expect_described("get", "/v1/keys", get("/v1/keys", admin));
  EXPECT_THAT(described_,
              ::testing::IsSupersetOf({"post /v1/keys 201", "delete /v1/keys/{id} 200",
                                       "delete /v1/keys/{id} 409", "get /v1/keys 200"}));
}

TEST_F(OpenApi, FilesAreThoseOfTheManifestInParts) {
  const std::string self = "/v1/jobs/" + submit_and_wait();
  const httplib::Result file = get(self + "/files/metrics.json");
  ASSERT_EQ(file->status, 200);
  EXPECT_EQ(file->body, R"({"runs":[]})");
  const std::string tag = file->get_header_value("ETag");
  EXPECT_EQ(get(self + "/files/metrics.json", {{"If-None-Match", tag}})->status, 304);
  for (const std::string& known : {"\"other\", " + tag, "W/" + tag, std::string("*")}) {
    EXPECT_EQ(get(self + "/files/metrics.json", {{"If-None-Match", known}})->status, 304) << known;
  }
  EXPECT_EQ(get(self + "/files/metrics.json", {{"If-None-Match", "\"other\""}})->status, 200);
  // RFC 9110, 14.2: a unit that is not understood and an invalid range are ignored.
  for (const char* range : {"lines=1-2", "bytes", "bytes=", "bytes=a-b", "items=0-0,bytes=0-0",
                            "bytes=5-2", "bytes=0-1,5-2", "bytes=5-2, 0-1", "bytes= 0-5",
                            "bytes=0-5,", "bytes=99999999999999999999-2"}) {
    EXPECT_EQ(get(self + "/files/metrics.json", {{"Range", range}})->status, 200) << range;
    EXPECT_EQ(get("/openapi.json", {{"Range", range}})->status, 200) << range;
  }
  for (const char* range : {"bytes=99999999999999999999-", "bytes=5-2", "bytes=0-5"}) {
    EXPECT_EQ(get("/healthz", {{"Range", range}})->status, 200) << range;  // has no parts
  }
  const httplib::Result rest =
      get(self + "/files/metrics.json", {{"Range", "bytes=2-99999999999999999999"}});
  EXPECT_EQ(rest->body, file->body.substr(2));
  // The name under which the library gets it is no way around these rules.
  EXPECT_EQ(get(self + "/files/metrics.json", {{"Requested-Range", "bytes=2-5"}})->status, 200);
  const httplib::Result part = get(self + "/files/metrics.json", {{"Range", "bytes=2-5"}});
  EXPECT_EQ(part->status, 206);
  EXPECT_EQ(part->body, "runs");
  expect_problem(get(self + "/files/manifest.json"), 404);
  for (const char* path : {"/files/../job.json", "/files/%2e%2e/job.json", "/files//etc/passwd",
                           "/logs/..", "/logs/%2e%2e", "/previews/../../job.json"}) {
    expect_problem(get(self + path), 404);
  }
}

}  // namespace
}  // namespace throng::server
