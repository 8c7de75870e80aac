#include "server/description/routes.h"

#include <gtest/gtest.h>

#include <array>

namespace throng::server {
namespace {

TEST(Routes, ParametersMatchTheirNames) {
  EXPECT_TRUE(fits("/v1/jobs/{id}", "/v1/jobs/j12ab"));
  EXPECT_FALSE(fits("/v1/jobs/{id}", "/v1/jobs/"));
  EXPECT_FALSE(fits("/v1/jobs/{id}", "/v1/jobs/j1/x"));
  EXPECT_FALSE(fits("/v1/jobs/{id}", "/v1/jobs/J1"));
  EXPECT_TRUE(fits("/v1/jobs/{id}/runs/{n}/metrics.csv", "/v1/jobs/j1/runs/12/metrics.csv"));
  EXPECT_FALSE(fits("/v1/jobs/{id}/runs/{n}/metrics", "/v1/jobs/j1/runs/1x/metrics"));
  EXPECT_TRUE(fits("/v1/jobs/{id}/logs/{name}", "/v1/jobs/j1/logs/run000_trace.log"));
  EXPECT_FALSE(fits("/v1/jobs/{id}/logs/{name}", "/v1/jobs/j1/logs/a/b"));
  EXPECT_TRUE(fits("/v1/jobs/{id}/files/{path}", "/v1/jobs/j1/files/images/run000/a.jpg"));
  EXPECT_FALSE(fits("/v1/jobs/{id}/files/{path}", "/v1/jobs/j1/files/"));
  EXPECT_TRUE(fits("/healthz", "/healthz"));
  EXPECT_FALSE(fits("/healthz", "/healthz/"));
}

TEST(Routes, PatternsCaptureTheParameters) {
  EXPECT_EQ(route_pattern("/v1/jobs/{id}/runs/{n}/metrics.csv"),
            R"(/v1/jobs/([a-z0-9]+)/runs/([0-9]+)/metrics\.csv)");
  EXPECT_EQ(route_pattern("/v1/jobs/{id}/files/{path}"), "/v1/jobs/([a-z0-9]+)/files/(.+)");
}

TEST(Routes, AllowedMethodsAreThoseOfThePath) {
  const std::array routes = {Route{Method::post, "/v1/jobs", Scope::read, nullptr},
                             Route{Method::get, "/v1/jobs", Scope::read, nullptr},
                             Route{Method::remove, "/v1/jobs/{id}", Scope::read, nullptr}};
  EXPECT_EQ(allowed_methods(routes, "/v1/jobs"), "POST, GET, HEAD");
  EXPECT_EQ(allowed_methods(routes, "/v1/jobs/j1"), "DELETE");
  EXPECT_EQ(allowed_methods(routes, "/v1"), "");
}

}  // namespace
}  // namespace throng::server
