// The API over a service that pretends, and a client of it.
#pragma once

#include <arpa/inet.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "server/api.h"
#include "server/http.h"
#include "tests/server/service_fixture.h"

namespace throng::server {

using nlohmann::json;

class ApiTest : public ServiceFixture {
 protected:
  ApiTest()
      : service(options(), executor),
        hooks(service.queue(), data.path(), {.post = {.allow_private = true}}),
        api(service, keys, hooks, {}),
        thread([this] { api.run(); }) {}
  ~ApiTest() override { api.stop(); }

  httplib::Client client() const { return httplib::Client("127.0.0.1", api.port()); }

  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) const {
    return client().Get(path, headers);
  }

  json get_json(const std::string& path) const { return json::parse(get(path)->body); }

  std::string submit() const {
    const httplib::Result answer = client().Post("/v1/jobs", kJob, "application/json");
    EXPECT_EQ(answer->status, 201);
    return json::parse(answer->body)["id"];
  }

  std::string submit_and_wait() const {
    const std::string id = submit();
    EXPECT_TRUE(wait_until([&] { return get_json("/v1/jobs/" + id)["state"] == "succeeded"; }));
    return id;
  }

  void expect_problem(const httplib::Result& answer, int status) const {
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, status);
    EXPECT_EQ(answer->get_header_value("Content-Type"), "application/problem+json");
    const json problem = json::parse(answer->body);
    EXPECT_EQ(problem["status"], status);
    EXPECT_FALSE(problem["title"].get<std::string>().empty());
  }

  // Sends bytes as they are and returns all that comes back until the server closes.
  std::string raw(const std::string& request) const { return raw_in_parts({request}); }

  // With a pause before each part but the first.
  std::string raw_in_parts(const std::vector<std::string>& parts,
                           std::chrono::milliseconds pause = std::chrono::milliseconds(300)) const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(api.port()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    for (const std::string& part : parts) {
      if (&part != &parts.front()) std::this_thread::sleep_for(pause);
      ::send(socket, part.data(), part.size(), MSG_NOSIGNAL);
    }
    std::string answer;
    char block[4096];
    for (ssize_t count = 0; (count = ::recv(socket, block, sizeof(block), 0)) > 0;) {
      answer.append(block, static_cast<std::size_t>(count));
    }
    ::close(socket);
    return answer;
  }

  Service service;
  Keys keys{data.path()};
  WebhookSender hooks;
  Api api;
  std::jthread thread;
};

}  // namespace throng::server
