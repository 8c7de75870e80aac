// The API over a service that pretends, and a client of it.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "server/http/http.h"
#include "server/routes/api.h"
#include "tests/server/http_client.h"
#include "tests/server/service_fixture.h"

namespace throng::server {

using nlohmann::json;

/// Connections may take their time, as the machine may be busy.
inline HttpOptions patient_http() {
  using namespace std::chrono_literals;
  return {
      .connection = {
          .head_time = 600s, .silence = 600s, .stalled = 600s, .idle = 600s, .body_timeout = 600s}};
}

class ApiTest : public ServiceFixture {
 protected:
  ApiTest()
      : service(options(), executor),
        hooks(service.queue(), data.path(),
              {.post = {.timeout = std::chrono::minutes(1), .allow_private = true}}),
        api(service, keys, hooks, patient_http()),
        thread([this] { api.run(); }) {}
  ~ApiTest() override { api.stop(); }

  HttpClient client() const { return HttpClient(api.port()); }

  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) const {
    return client().Get(path, headers);
  }

  json get_json(const std::string& path) const { return json::parse(get(path)->body); }

  std::string submit() const {
    const httplib::Result answer = client().Post("/v1/jobs", kJob, "application/json");
    EXPECT_EQ(answer->status, 201);
    return json::parse(answer->body)["id"];
  }

  /// The types of what a stream of events has sent, in order, when it ends or `is_enough`.
  std::vector<std::string> streamed(
      const std::string& path,
      const std::function<bool(const std::vector<std::string>&)>& is_enough) const {
    constexpr std::string_view kBegin = "event: ";
    std::string text;
    std::vector<std::string> types;
    const auto receive = [&](const char* block, std::size_t count) {
      text.append(block, count);
      for (auto end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
        const std::string line = text.substr(0, end);
        if (line.starts_with(kBegin)) types.push_back(line.substr(kBegin.size()));
        text.erase(0, end + 1);
      }
      return !is_enough(types);
    };
    client().Get(path, {{"Accept", "text/event-stream"}}, receive);
    return types;
  }

  std::string submit_and_wait() const {
    const std::string id = submit();
    EXPECT_TRUE(wait_until([&] { return get_json("/v1/jobs/" + id)["state"] == "succeeded"; }));
    return id;
  }

  /// The report of a job once it is made, as far as that takes a minute: the service lets its
  /// clients wait five seconds, and ask again.
  httplib::Result report_of(const std::string& id) const {
    constexpr int kTries = 12;
    constexpr int kAskAgain = 202;
    httplib::Result page = get("/v1/jobs/" + id + "/report");
    for (int i = 0; i < kTries && page->status == kAskAgain; ++i) {
      page = get("/v1/jobs/" + id + "/report");
    }
    return page;
  }

  void expect_problem(const httplib::Result& answer, int status) const {
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, status);
    EXPECT_EQ(answer->get_header_value("Content-Type"), "application/problem+json");
    const json problem = json::parse(answer->body);
    EXPECT_EQ(problem["status"], status);
    EXPECT_FALSE(problem["title"].get<std::string>().empty());
  }

  /// Sends bytes as they are and returns all that comes back until the server closes.
  std::string raw(const std::string& request) const {
    const RawConnection connection(api.port());
    connection.send(request);
    return connection.read();
  }

  Service service;
  Keys keys{data.path()};
  WebhookSender hooks;
  Api api;
  std::jthread thread;
};

}  // namespace throng::server
