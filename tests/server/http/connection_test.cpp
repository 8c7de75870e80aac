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

constexpr const char* kChunked =
    " HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
    "Transfer-Encoding: chunked\r\n";

std::string in_chunks(const std::string& body, std::size_t size) {
  std::string text;
  for (std::size_t at = 0; at < body.size(); at += size) {
    const std::string chunk = body.substr(at, size);
    text += fmt::format("{:x};n={}\r\n{}\r\n", chunk.size(), at, chunk);
  }
  return text + "0\r\nX-Sum: 1\r\n\r\n";
}

TEST_F(HostileClients, ChunkedBodiesAreThoseWithALength) {
  const std::string body = kJob;
  for (const std::size_t size : {std::size_t{1}, std::size_t{50}, body.size()}) {
    const RawConnection connection(api.port());
    for (int i = 0; i < 2; ++i) {  // on the same connection
      connection.send(std::string("POST /v1/jobs?dry_run") + kChunked + "\r\n" +
                      in_chunks(body, size));
    }
    connection.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    const std::string answers = connection.read();
    std::size_t count = 0;
    for (auto at = answers.find("HTTP/1.1 200"); at != std::string::npos;
         at = answers.find("HTTP/1.1 200", at + 1)) {
      ++count;
    }
    EXPECT_EQ(count, 3U) << answers;
  }
}

TEST_F(HostileClients, ChunksAreReadOnceNothingSpeaksAgainstThem) {
  // The chunks never come: the answers do not wait for them.
  EXPECT_THAT(raw(std::string("POST /v1/jobs") + kChunked + "\r\n2000000\r\n"),
              StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(raw(std::string("POST /v1/nothing") + kChunked + "\r\n"), StartsWith("HTTP/1.1 404"));
  const std::string expecting = std::string(kChunked) + "Expect: 100-continue\r\n\r\n";
  const RawConnection connection(api.port());
  connection.send("POST /v1/jobs?dry_run" + expecting);
  EXPECT_EQ(connection.read("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  connection.send(in_chunks("[]", 1));
  EXPECT_THAT(connection.read("\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
  keys.create("somebody", Scope::admin);
  EXPECT_THAT(raw("POST /v1/jobs" + expecting), StartsWith("HTTP/1.1 401"));
}

TEST_F(HostileClients, ChunksThatTakeTooLongAreCutOff) {
  HttpOptions options = patient_http();
  options.connection.silence = std::chrono::milliseconds(20);
  HttpServer hasty(options, [](const httplib::Request&, httplib::Response& response,
                               const HttpError& error) { response.status = error.status; });
  hasty.routes().Post("/", [](const httplib::Request&, httplib::Response&) {});
  const std::jthread serving([&] { hasty.run(); });
  for (const char* part : {"", "5", "5\r\nhel", "5\r\nhello\r\n", "0\r\n", "0\r\nX: y\r\n"}) {
    const RawConnection connection(hasty.port());
    connection.send(std::string("POST /") + kChunked + "\r\n" + part);
    EXPECT_THAT(connection.read(), StartsWith("HTTP/1.1 408 ")) << part;
  }
  hasty.stop();
  options = patient_http();
  options.connection.body_timeout = std::chrono::milliseconds(0);
  options.connection.body_bytes_per_s = 1e15;  // which nobody reaches
  HttpServer demanding(options, [](const httplib::Request&, httplib::Response& response,
                                   const HttpError& error) { response.status = error.status; });
  const std::jthread serving_too([&] { demanding.run(); });
  const RawConnection connection(demanding.port());
  connection.send(std::string("POST /") + kChunked + "\r\n1\r\nx");
  EXPECT_THAT(connection.read(), StartsWith("HTTP/1.1 408 "));
  demanding.stop();
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
  const auto chunked = [&](std::size_t bytes) {
    const RawConnection connection(small.port());
    connection.send(std::string("POST /") + kChunked + "Connection: close\r\n\r\n" +
                    in_chunks(std::string(bytes, 'x'), 100'000));
    return connection.read();
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(wait_until([&] { return chunked(2 << 20).ends_with("2097152"); }));
  }
  EXPECT_THAT(chunked(4 << 20), StartsWith("HTTP/1.1 503 "));
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
