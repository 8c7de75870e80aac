// Request smuggling: no byte of one request may be taken for another request, nothing is inflated,
// and nothing of a body is read for those who have no key. And what honest clients rely on.
#include <gmock/gmock.h>

#include "tests/server/api_fixture.h"

namespace throng::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kHost = "Host: localhost\r\n";

std::size_t count_occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class Smuggling : public ApiTest {
 protected:
  // Sends a request whose rest would delete the job if it were read as a request of its own. There
  // must be one answer, of this status, and then the connection's end.
  void expect_one_answer(const std::string& head, int status) {
    const std::string answers = raw(head + inner());
    EXPECT_THAT(answers, StartsWith(fmt::format("HTTP/1.1 {} ", status))) << head;
    EXPECT_EQ(count_occurrences(answers, "HTTP/1."), 1U) << head << answers;
    EXPECT_THAT(answers, HasSubstr("Connection: close\r\n")) << head;
    EXPECT_EQ(get("/v1/jobs/" + job)->status, 200) << head;
  }

  std::string inner() const {
    return fmt::format("DELETE /v1/jobs/{} HTTP/1.1\r\nHost: localhost\r\n\r\n", job);
  }

  const std::string job = submit_and_wait();
};

TEST_F(Smuggling, MethodsWithoutABodyHaveNone) {
  for (const char* method : {"GET", "HEAD", "OPTIONS"}) {
    const std::string head = fmt::format("{} /v1/version HTTP/1.1\r\n{}", method, kHost);
    expect_one_answer(fmt::format("{}Content-Length: {}\r\n\r\n", head, inner().size()), 400);
    expect_one_answer(head + "Content-Length: 1\r\n\r\n", 400);
    expect_one_answer(head + "Transfer-Encoding: chunked\r\n\r\n", 400);
    expect_one_answer(head + "Content-Length: 0\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
                      400);
  }
  for (const char* method : {"TRACE", "CONNECT", "PRI", "PROPFIND", "get", "BREW"}) {
    expect_one_answer(fmt::format("{} /v1/version HTTP/1.1\r\n{}Content-Length: {}\r\n\r\n", method,
                                  kHost, inner().size()),
                      501);
  }
}

TEST_F(Smuggling, UnclearLengthsEndTheConnection) {
  const std::string head =
      fmt::format("POST /v1/jobs HTTP/1.1\r\n{}Content-Type: application/json\r\n", kHost);
  for (const char* length :
       {"Content-Length: 0\r\nContent-Length: 70\r\n", "Content-Length: 0, 70\r\n",
        "Content-Length: +0\r\n", "Content-Length: -1\r\n", "Content-Length: 0x0\r\n",
        "Content-Length: 0 0\r\n", "Content-Length:\r\n", "Content-Length: %30\r\n",
        "Content-Length: 18446744073709551616\r\n", "Content-Length : 0\r\n",
        "Content-Length: 0\r\n\tTransfer-Encoding: chunked\r\n", "Content-Length: 0\nX: y\r\n",
        "X: y\rContent-Length: 0\r\n", "Content-Length: 4\r\nTransfer-Encoding: chunked\r\n",
        "Transfer-Encoding\t: chunked\r\n"}) {
    expect_one_answer(fmt::format("{}{}\r\n", head, length), 400);
  }
  expect_one_answer(head + "Transfer-Encoding: xchunked\r\n\r\n0\r\n\r\n", 501);
}

TEST_F(Smuggling, MalformedChunksEndTheConnection) {
  const std::string head = fmt::format(
      "POST /v1/jobs?dry_run HTTP/1.1\r\n{}Content-Type: application/json\r\n"
      "Transfer-Encoding: chunked\r\n",
      kHost);
  for (const char* body :
       {"0x0\r\n\r\n", "0 \r\n\r\n", "0\n\n", "-1\r\n", "ffffffffffffffff1\r\n",
        "3\r\nabcd\r\n0\r\n\r\n", "2\r\n{}0\r\n\r\n", "\r\n", "0\r\n\n", "0;x=\"\r\n\"\r\n\r\n"}) {
    expect_one_answer(head + "\r\n" + body, 400);
  }
  expect_one_answer(head + "Content-Length: 2\r\n\r\n0\r\n\r\n", 400);
  // Trailers change nothing: the body ends behind them, whatever they say.
  const std::string next =
      fmt::format("GET /healthz HTTP/1.1\r\n{}Connection: close\r\n\r\n", kHost);
  for (const char* trailers : {"", "Content-Length: 70\r\n", "Transfer-Encoding: chunked\r\n"}) {
    const std::string answers = raw(head + "\r\n2\r\n[]\r\n0\r\n" + trailers + "\r\n" + next);
    EXPECT_THAT(answers, StartsWith("HTTP/1.1 400 ")) << "an empty list is no job";
    EXPECT_THAT(answers, HasSubstr("HTTP/1.1 200 OK"));
    EXPECT_EQ(count_occurrences(answers, "HTTP/1."), 2U) << answers;
  }
}

TEST_F(Smuggling, RefusedBodiesAreNotReadAsRequests) {
  const std::string length = fmt::format("Content-Length: {}\r\n", inner().size());
  const auto head = [&](const std::string& line, const std::string& fields) {
    return line + " HTTP/1.1\r\n" + kHost + length + fields + "\r\n";
  };
  expect_one_answer(head("POST /v1/version", ""), 405);
  expect_one_answer(head("POST /v1/nothing", ""), 404);
  expect_one_answer(head("PUT /v1/jobs", ""), 405);
  expect_one_answer(head("DELETE /v1/jobs", ""), 405);
  expect_one_answer(head("POST /v1/jobs", "Content-Encoding: br\r\n"), 415);
  expect_one_answer(head("POST /v1/jobs", "Expect: the worst\r\n"), 417);
  expect_one_answer(head("POST /v1/jobs", "Origin: http://evil\r\n"), 403);
  expect_one_answer("POST /v1/jobs HTTP/1.1\r\nHost: evil\r\n" + length + "\r\n", 421);
  keys.create("somebody", Scope::admin);
  EXPECT_THAT(raw(head("POST /v1/jobs", "") + inner()), StartsWith("HTTP/1.1 401 "));
  EXPECT_EQ(count_occurrences(raw(head("POST /v1/jobs", "") + inner()), "HTTP/1."), 1U);
}

TEST_F(Smuggling, ConnectionsOfRefusedRequestsAreClosed) {
  // The library gives up in the middle of these bodies and would go on with the rest.
  const std::string part = "--B\r\nContent-Disposition: form-data; name=\"a\"\r\n\r\nh\r\n";
  std::string body;
  for (int i = 0; i < 1100; ++i) body += part;
  body += inner() + "--B--\r\n";
  const std::string head = fmt::format(
      "POST /v1/jobs HTTP/1.1\r\n{}Content-Type: multipart/form-data; boundary=B\r\n"
      "Content-Length: {}\r\n\r\n",
      kHost, body.size());
  // This one is read to its end: after its own answer comes that of the next request.
  const std::string next =
      fmt::format("GET /healthz HTTP/1.1\r\n{}Connection: close\r\n\r\n", kHost);
  const std::string answers = raw(head + body + next);
  EXPECT_EQ(count_occurrences(answers, "HTTP/1."), 2U) << answers;
  EXPECT_THAT(answers, StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(answers, HasSubstr("HTTP/1.1 200 OK"));
  // A range that the library would refuse in the middle is ignored, and the body read to its end.
  const std::string ranges =
      "Connection: close\r\nRange: bytes=" + std::string(6000, '9') + "-\r\n";
  EXPECT_EQ(count_occurrences(
                raw(fmt::format("POST /v1/jobs HTTP/1.1\r\n{}{}Content-Length: {}\r\n\r\n{}", kHost,
                                ranges, inner().size(), inner())),
                "HTTP/1."),
            1U);
  EXPECT_EQ(get("/v1/jobs/" + job)->status, 200);
}

TEST_F(Smuggling, NothingIsInflated) {
  // A megabyte of zeros in gzip's format; br and lists of codings are refused in the same place.
  const std::string head = fmt::format(
      "POST /v1/jobs HTTP/1.1\r\n{}Content-Type: application/json\r\nContent-Length: 5\r\n", kHost);
  for (const char* coding :
       {"br", "gzip", "deflate", "BR", "identity, br", "%62r", "x-gzip", "gzip;q=1"}) {
    const std::string answer =
        raw(fmt::format("{}Content-Encoding: {}\r\n\r\nabcde", head, coding));
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 415 ")) << coding;
    EXPECT_THAT(answer, HasSubstr("application/problem+json"));
  }
  EXPECT_THAT(raw(head + "Content-Encoding: identity\r\nContent-Encoding: br\r\n\r\nabcde"),
              StartsWith("HTTP/1.1 415 "));
  EXPECT_THAT(raw(head + "Content-Encoding: identity\r\nConnection: close\r\n\r\nabcde"),
              StartsWith("HTTP/1.1 400 "));
}

TEST_F(Smuggling, KeysComeBeforeBodies) {
  const std::string reader = keys.create("reader", Scope::read);
  const auto head = [](const std::string& line, const std::string& fields) {
    return fmt::format(
        "{} HTTP/1.1\r\n{}Content-Type: application/json\r\nContent-Length: 1000\r\n{}\r\n", line,
        kHost, fields);
  };
  // The body never comes: the answer does not wait for it (patient_http() waits for minutes).
  for (const char* line :
       {"POST /v1/jobs", "POST /v1/calibrations", "POST /v1/scenarios?name=a", "PATCH /v1/jobs/a",
        "DELETE /v1/jobs/a", "POST /v1/webhooks", "POST /v1/jobs/a/clone"}) {
    EXPECT_THAT(raw(head(line, "")), StartsWith("HTTP/1.1 401 ")) << line;
    EXPECT_THAT(raw(head(line, "Authorization: Bearer " + reader + "\r\n")),
                StartsWith("HTTP/1.1 403 "))
        << line;
    EXPECT_THAT(raw(head(line, "Expect: 100-continue\r\n")), StartsWith("HTTP/1.1 401 ")) << line;
  }
}

TEST_F(Smuggling, PipelinedRequestsAreAnsweredInOrder) {
  const std::string post = fmt::format(
      "POST /v1/jobs?dry_run HTTP/1.1\r\n{}Content-Type: application/json\r\nContent-Length: "
      "{}\r\n\r\n{}",
      kHost, std::string_view(kJob).size(), kJob);
  const std::string answers =
      raw(post + "GET /v1/version HTTP/1.1\r\n" + kHost + "\r\n" + post +
          "\r\nGET /healthz HTTP/1.1\r\n" + kHost + "Connection: close\r\n\r\n" + inner());
  EXPECT_EQ(count_occurrences(answers, "HTTP/1.1 200 OK"), 4U) << answers;
  EXPECT_EQ(count_occurrences(answers, "HTTP/1."), 4U);
  EXPECT_LT(answers.find("\"valid\""), answers.find("\"api\""));
  EXPECT_EQ(get("/v1/jobs/" + job)->status, 200);
}

TEST_F(Smuggling, ContinueIsSaidOnceTheBodyIsWanted) {
  const std::string body(kJob);
  const std::string head = fmt::format(
      "POST /v1/jobs?dry_run HTTP/1.1\r\n{}Content-Type: application/json\r\nConnection: "
      "close\r\nExpect: 100-continue\r\nContent-Length: {}\r\n\r\n",
      kHost, body.size());
  EXPECT_THAT(raw(head + body), StartsWith("HTTP/1.1 200 ")) << "it is there already";
  const RawConnection connection(api.port());
  connection.send(head);
  EXPECT_EQ(connection.read("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  connection.send(body);
  EXPECT_THAT(connection.read(), StartsWith("HTTP/1.1 200 OK"));
}

TEST_F(Smuggling, OldClientsAreServed) {
  const std::string one = raw("GET /v1/version HTTP/1.0\r\n\r\n");
  EXPECT_THAT(one, StartsWith("HTTP/1.1 200 OK"));
  EXPECT_THAT(one, HasSubstr("Connection: close"));
  const std::string two = raw(
      "GET /v1/version HTTP/1.0\r\nConnection: keep-alive\r\n\r\nGET /healthz HTTP/1.0\r\n\r\n");
  EXPECT_EQ(count_occurrences(two, "HTTP/1.1 200 OK"), 2U);
  EXPECT_THAT(raw("GET /v1/version\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(raw("POST /v1/jobs/" + job +
                  "/retry HTTP/1.1\r\nHost: localhost\r\nConnection: "
                  "close\r\n\r\n"),
              StartsWith("HTTP/1.1 409 "))
      << "curl -X POST has neither a body nor a length";
}

TEST_F(Smuggling, ValuesReachTheHandlersAsSent) {
  // The library would decode it, and see two fields.
  const std::string answer =
      raw("GET /v1/jobs HTTP/1.1\r\nHost: localhost\r\nX: a%0d%0aAuthorization: b\r\n"
          "Connection: close\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(
      raw("GET /v1/jobs/a%0d%0aX:%20y HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
      ::testing::AllOf(StartsWith("HTTP/1.1 404 "), Not(HasSubstr("\r\nX: y"))));
}

}  // namespace
}  // namespace throng::server
