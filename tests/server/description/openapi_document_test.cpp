#include "server/description/openapi.h"

#include <gtest/gtest.h>

#include <vector>

namespace throng::server {
namespace {

using nlohmann::json;

json described_operation(const Route& route, const char* method) {
  const std::vector<Route> routes = {route};
  return json(openapi_document(routes, {}))["paths"][route.path][method];
}

std::vector<std::string> member_names(const json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

TEST(OpenApiDocument, ProblemsFollowFromTheRoute) {
  const Route open = {Method::get, "/healthz", Scope::anybody, nullptr, {.answers = {done("x")}}};
  EXPECT_EQ(member_names(described_operation(open, "get")["responses"]),
            std::vector<std::string>{"204"});
  EXPECT_EQ(described_operation(open, "get")["security"], json::array());
  const Route sent = {Method::post,
                      "/v1/a/{id}",
                      Scope::submit,
                      nullptr,
                      {.body = json_body("Job"), .answers = {ok("x", "Job")}, .problems = {409}}};
  EXPECT_EQ(member_names(described_operation(sent, "post")["responses"]),
            (std::vector<std::string>{"200", "400", "401", "403", "404", "409", "413", "415", "429",
                                      "503"}));
  EXPECT_FALSE(described_operation(sent, "post").contains("security"));
}

TEST(OpenApiDocument, FilesComeInParts) {
  const Route route = {Method::get,
                       "/v1/jobs/{id}/logs/{name}",
                       Scope::read,
                       nullptr,
                       {.parameters = {path_part("name", "Name of the log."),
                                       {"limit", fields::integers(1, 9), "Most.", 5}},
                        .answers = {file("The log.", {{"text/plain"}})}}};
  const json operation = described_operation(route, "get");
  EXPECT_EQ(operation["parameters"], json::parse(R"([
    {"name": "id", "in": "path", "required": true, "description": "Id of the job.",
     "schema": {"type": "string", "pattern": "^[a-z0-9]+$"}},
    {"name": "name", "in": "path", "required": true, "description": "Name of the log.",
     "schema": {"type": "string", "pattern": "^[A-Za-z0-9._-]+$"}},
    {"name": "limit", "in": "query", "description": "Most.",
     "schema": {"type": "integer", "minimum": 1, "maximum": 9, "default": 5}},
    {"name": "Range", "in": "header", "schema": {"type": "string"},
     "description": "One range of bytes; other ranges are answered with the whole content."}])"));
  for (const char* status : {"200", "206"}) {
    EXPECT_EQ(member_names(operation["responses"][status]["content"]),
              std::vector<std::string>{"text/plain"});
  }
  EXPECT_TRUE(operation["responses"].contains("304"));
  EXPECT_TRUE(operation["responses"].contains("416"));
}

}  // namespace
}  // namespace throng::server
