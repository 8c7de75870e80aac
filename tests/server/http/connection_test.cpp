// The bare port against malicious clients.
#include "server/http/connection.h"

#include <gmock/gmock.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "base/error.h"
#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using HostileClients = ApiTest;

TEST_F(HostileClients, EndlessHeadersAreCutOff) {
  const std::string line(200'000, 'x');
  EXPECT_THAT(raw("GET /" + line), ::testing::AnyOf("", StartsWith("HTTP/1.1 4")));
  EXPECT_THAT(raw("GET /healthz HTTP/1.1\r\nHost: localhost\r\nX: " + line + "\r\n\r\n"),
              ::testing::AnyOf("", StartsWith("HTTP/1.1 4")));
  std::string many = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n";
  for (int i = 0; i < 20'000; ++i) many += fmt::format("X-{}: y\r\n", i);
  EXPECT_THAT(raw(many + "\r\n"), ::testing::AnyOf("", StartsWith("HTTP/1.1 4")));
  EXPECT_EQ(get("/healthz")->status, 200);
}

TEST(Connection, AHeadInPiecesIsReadToItsEnd) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  const ConnectionLimits limits = patient_http().connection;
  Connection connection(ends[0], limits);
  std::jthread client([&] {
    for (const char byte : std::string("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")) {
      EXPECT_EQ(::send(ends[1], &byte, 1, MSG_NOSIGNAL), 1);
      EXPECT_TRUE(wait_until([&] {
        int unread = 0;
        return ::ioctl(ends[0], FIONREAD, &unread) == 0 && unread == 0;
      }));
    }
  });
  const auto head = connection.read_head();
  client.join();
  ASSERT_TRUE(std::holds_alternative<RequestHead>(head));
  EXPECT_EQ(std::get<RequestHead>(head).path, "/healthz");
  ::close(ends[1]);
}

TEST_F(HostileClients, AHeadThatDoesNotEndIsAnswered) {
  HttpOptions options = patient_http();
  options.connection.head_time = std::chrono::milliseconds(20);
  HttpServer hasty(options, [](const httplib::Request&, httplib::Response& response,
                               const HttpError& error) { response.status = error.status; });
  const std::jthread serving([&] { hasty.run(); });
  const RawConnection connection(hasty.port());
  connection.send("GET /healthz HTTP/1.1\r\nHost: loc");
  EXPECT_THAT(connection.read(), StartsWith("HTTP/1.1 408 "));
  hasty.stop();
}

TEST_F(HostileClients, LargeBodiesAreRefusedUnread) {
  const std::string head =
      "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n";
  // The body never comes: the answer does not wait for it (patient_http() waits for minutes).
  EXPECT_THAT(raw(head + "Content-Length: 2000000\r\n\r\n"), StartsWith("HTTP/1.1 413"));
  keys.create("somebody", Scope::admin);
  EXPECT_THAT(raw("POST /v1/calibrations HTTP/1.1\r\nHost: localhost\r\nContent-Type: "
                  "application/json\r\nContent-Length: 2000000\r\n\r\n"),
              StartsWith("HTTP/1.1 401"))
      << "strangers may not send bodies anywhere";
}

TEST_F(HostileClients, RequestsSentTogetherAreAllAnswered) {
  const std::string one = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n";
  const std::string answers = raw(one + "\r\n" + one + "\r\n" + one + "Connection: close\r\n\r\n");
  std::size_t count = 0;
  for (auto at = answers.find("HTTP/1.1 200"); at != std::string::npos;
       at = answers.find("HTTP/1.1 200", at + 1)) {
    ++count;
  }
  EXPECT_EQ(count, 3U);
}

TEST_F(HostileClients, UploadsShareTheMemoryThereIs) {
  HttpOptions options;
  options.admit_body = [](const httplib::Request&) {
    return BodyAdmission{std::size_t{64} << 20U};
  };
  options.max_all_body_bytes = 3 << 20;
  HttpServer small(options, [](const httplib::Request&, httplib::Response& response,
                               const HttpError& error) { response.status = error.status; });
  small.routes().Post("/", [](const httplib::Request& request, httplib::Response& response) {
    response.set_content(std::to_string(request.body.size()), "text/plain");
  });
  const std::jthread serving([&] { small.run(); });
  HttpClient honest(small.port());
  const std::string fits(2 << 20, 'x');
  // The memory is given back a moment after the answer.
  const auto is_taken = [&] {
    return wait_until([&] { return honest.Post("/", fits, "text/plain")->body == "2097152"; });
  };
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(is_taken());
  EXPECT_EQ(honest.Post("/", std::string(4 << 20, 'x'), "text/plain")->status, 503);
  EXPECT_TRUE(is_taken());
  small.stop();
}

TEST_F(HostileClients, RequestsThatCannotBeCheckedAreRefused) {
  HttpOptions options;
  options.admit_body = [](const httplib::Request& request) -> BodyAdmission {
    if (request.path == "/locked") throw EnvironmentError("the database is locked");
    throw HttpError{418, "no tea"};
  };
  HttpServer server(options, [](const httplib::Request&, httplib::Response& response,
                                const HttpError& error) { response.status = error.status; });
  const std::jthread serving([&] { server.run(); });
  HttpClient client(server.port());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(client.Post("/locked", "x", "text/plain")->status, 503);
    EXPECT_EQ(client.Post("/", "x", "text/plain")->status, 418);
  }
  server.stop();
}

}  // namespace
}  // namespace throng::server
