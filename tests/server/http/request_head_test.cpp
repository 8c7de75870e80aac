// Parsing of a request's head, and how each malformed or ambiguous one is refused.
#include "server/http/request_head.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace throng::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

int response_status(const std::string& head) {
  const auto read = parse_request_head(head);
  const auto* error = std::get_if<HeadError>(&read);
  return error == nullptr ? 200 : error->status;
}

int status_of_get(const std::string& fields) {
  return response_status("GET /v1/jobs HTTP/1.1\r\nHost: a\r\n" + fields + "\r\n");
}

int status_of_post(const std::string& fields) {
  return response_status("POST /v1/jobs HTTP/1.1\r\nHost: a\r\n" + fields + "\r\n");
}

RequestHead taken(const std::string& head) {
  auto read = parse_request_head(head);
  EXPECT_TRUE(std::holds_alternative<RequestHead>(read)) << head;
  return std::holds_alternative<RequestHead>(read) ? std::get<RequestHead>(read) : RequestHead{};
}

TEST(RequestHead, IsReadAsSent) {
  const RequestHead head = taken(
      "POST /v1/jobs/a%20b?x=%41+1 HTTP/1.1\r\nHost: localhost:80\r\nAccept:\t */* \r\n"
      "content-LENGTH: 0012\r\nExpect: 100-Continue\r\nX-Empty:\r\n\r\n");
  EXPECT_EQ(head.method, "POST");
  EXPECT_EQ(head.target, "/v1/jobs/a%20b?x=%41+1");
  EXPECT_EQ(head.path, "/v1/jobs/a b");
  EXPECT_EQ(head.content_length, 12U);
  EXPECT_TRUE(head.expects_continue);
  EXPECT_TRUE(head.keeps_connection);
  ASSERT_EQ(head.fields.size(), 3U);
  EXPECT_EQ(head.fields[1].value, "*/*");
  EXPECT_EQ(head.fields[2].value, "");
  EXPECT_EQ(library_text(head),
            "POST /v1/jobs/a%20b?x=%41+1 HTTP/1.1\r\nHost: localhost:80\r\nAccept: */*\r\n"
            "X-Empty: \r\nContent-Length: 12\r\n\r\n");
}

TEST(RequestHead, ConnectionsPersistAsTheClientWishes) {
  const auto keeps = [](const std::string& version, const std::string& fields) {
    return taken("GET / HTTP/" + version + "\r\nHost: a\r\n" + fields + "\r\n").keeps_connection;
  };
  EXPECT_TRUE(keeps("1.1", ""));
  EXPECT_FALSE(keeps("1.1", "Connection: Close\r\n"));
  EXPECT_FALSE(keeps("1.1", "Connection: keep-alive\r\nConnection: TE, close\r\n"));
  EXPECT_FALSE(keeps("1.0", ""));
  EXPECT_TRUE(keeps("1.0", "Connection: Keep-Alive\r\n"));
  EXPECT_FALSE(keeps("1.0", "Connection: keep-alive, close\r\n"));
}

TEST(RequestHead, TheRequestLineIsStrict) {
  const auto status = [](const std::string& line) {
    return response_status(line + "\r\nHost: a\r\n\r\n");
  };
  EXPECT_EQ(status("GET / HTTP/1.1"), 200);
  EXPECT_EQ(status("GET / HTTP/1.0"), 200);
  for (const char* line : {"GET /",
                           "GET  / HTTP/1.1",
                           "GET / HTTP/1.1 ",
                           " GET / HTTP/1.1",
                           "GET\t/ HTTP/1.1",
                           "GET / / HTTP/1.1",
                           "GET / http/1.1",
                           "GET / HTTP/1.10",
                           "GET / HTTP/11",
                           "/ HTTP/1.1",
                           "G(T / HTTP/1.1",
                           "GET http://a/ HTTP/1.1",
                           "GET a HTTP/1.1",
                           "OPTIONS * HTTP/1.1",
                           "GET /a#b HTTP/1.1",
                           "GET /\xc3\xa4 HTTP/1.1",
                           "GET /\x7f HTTP/1.1",
                           "GET /% HTTP/1.1",
                           "GET /%4 HTTP/1.1",
                           "GET /%4g HTTP/1.1",
                           "GET /%u0041 HTTP/1.1",
                           "GET /%00 HTTP/1.1",
                           "GET /?a=%00 HTTP/1.1",
                           "GET /?a?b HTTP/1.1",
                           ""}) {
    EXPECT_EQ(status(line), 400) << line;
  }
  for (const char* line : {"get / HTTP/1.1", "Get / HTTP/1.1", "PRI / HTTP/1.1", "TRACE / HTTP/1.1",
                           "CONNECT / HTTP/1.1", "PURGE / HTTP/1.1"}) {
    EXPECT_EQ(status(line), 501) << line;
  }
  for (const char* line : {"GET / HTTP/2.0", "GET / HTTP/0.9", "GET / HTTP/1.2"}) {
    EXPECT_EQ(status(line), 505) << line;
  }
  EXPECT_EQ(status("GET /" + std::string(kMaxLineBytes, 'x') + " HTTP/1.1"), 414);
}

TEST(RequestHead, FieldsAreStrict) {
  EXPECT_EQ(status_of_get("X: \xc3\xa4\r\nX: again\r\n"), 200);
  for (const std::string fields : {"X : y\r\n", " X: y\r\n", "X: y\r\n z\r\n", "X: y\r\n\tz\r\n",
                                   "X\r\n", ": y\r\n", "X(: y\r\n", "X: a\x01\r\n", "X: a\x7f\r\n",
                                   "X: a\nY: b\r\n", "X: a\rY: b\r\n", "X: a\r\r\n"}) {
    EXPECT_EQ(status_of_get(fields), 400) << fields;
  }
  EXPECT_EQ(status_of_get(std::string("X: a\0b\r\n", 8)), 400);
  EXPECT_EQ(response_status("GET / HTTP/1.1\nHost: a\n\n"), 400);
  EXPECT_EQ(response_status("GET / HTTP/1.1\r\nHost: a\r\n\n\r\n"), 400);
  EXPECT_EQ(status_of_get("X: " + std::string(kMaxLineBytes, 'y') + "\r\n"), 431);
  std::string many;
  for (std::size_t i = 0; i < kMaxHeaderFields; ++i) many += "X: y\r\n";
  EXPECT_EQ(status_of_get(many), 431);
}

TEST(RequestHead, NamesOneHost) {
  const auto status = [](const std::string& fields) {
    return response_status("GET / HTTP/1.1\r\n" + fields + "\r\n");
  };
  EXPECT_EQ(status(""), 400);
  EXPECT_EQ(status("Host: a\r\nhost: a\r\n"), 400);
  EXPECT_EQ(status("Host: a, b\r\n"), 400);
  EXPECT_EQ(status("Host: a/b\r\n"), 400);
  EXPECT_EQ(status("Host: a@b\r\n"), 400);
  EXPECT_EQ(status("Host: [::1]:80\r\n"), 200);
  EXPECT_EQ(response_status("GET / HTTP/1.0\r\n\r\n"), 200);
}

TEST(RequestHead, LengthsAreOnePlainNumber) {
  EXPECT_EQ(status_of_post("Content-Length: 5\r\n"), 200);
  EXPECT_EQ(status_of_post(""), 200);
  for (const char* length :
       {"", "+5", "-5", "5,5", "5, 5", "5 5", "0x5", "5a", "a5", "5.0", "1e1", "%35", "\"5\"", "5;",
        "18446744073709551621", "9999999999999999", "\xd9\xa5"}) {
    EXPECT_EQ(status_of_post(fmt::format("Content-Length: {}\r\n", length)), 400) << length;
  }
  EXPECT_EQ(status_of_post("Content-Length: 5\r\nContent-Length: 5\r\n"), 400);
  EXPECT_EQ(status_of_post("Content-Length: 5\r\ncontent-length: 6\r\n"), 400);
  // A name that only resembles the field is none.
  EXPECT_EQ(taken("POST / HTTP/1.1\r\nHost: a\r\nContent_Length: 5\r\n\r\n").content_length, 0U);
}

TEST(RequestHead, OneTransferCodingIsKnown) {
  EXPECT_EQ(status_of_post("Transfer-Encoding: chunked\r\n"), 200);
  EXPECT_EQ(status_of_post("Transfer-Encoding: Chunked\r\n"), 200);
  EXPECT_FALSE(taken("POST / HTTP/1.1\r\nHost: a\r\n\r\n").is_chunked);
  const RequestHead head = taken(
      "POST / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_TRUE(head.is_chunked && head.expects_continue && head.content_length == 0);
  for (const char* coding : {"gzip, chunked", "chunked, chunked", "xchunked", "chunked;q=1",
                             "\x0b"
                             "chunked",
                             "identity", "", "chunked,"}) {
    EXPECT_THAT(status_of_post(fmt::format("Transfer-Encoding: {}\r\n", coding)),
                ::testing::AnyOf(400, 501))
        << coding;
  }
  EXPECT_EQ(status_of_post("Transfer-Encoding: chunked\r\nContent-Length: 5\r\n"), 400);
  EXPECT_EQ(status_of_post("Content-Length: 5\r\nTRANSFER-ENCODING: x\r\n"), 400);
  EXPECT_EQ(status_of_post("Transfer-Encoding: chunked\r\nTransfer-Encoding: x\r\n"), 400);
  EXPECT_EQ(response_status("POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n"), 400);
}

TEST(RequestHead, OnlySomeMethodsHaveBodies) {
  for (const char* method : {"GET", "HEAD", "OPTIONS"}) {
    const std::string line = fmt::format("{} / HTTP/1.1\r\nHost: a\r\n", method);
    EXPECT_EQ(response_status(line + "Content-Length: 0\r\n\r\n"), 200) << method;
    EXPECT_EQ(response_status(line + "Content-Length: 1\r\n\r\n"), 400) << method;
    EXPECT_EQ(response_status(line + "Transfer-Encoding: chunked\r\n\r\n"), 400) << method;
  }
  for (const char* method : {"POST", "PUT", "PATCH", "DELETE"}) {
    const std::string line = fmt::format("{} / HTTP/1.1\r\nHost: a\r\n", method);
    EXPECT_EQ(response_status(line + "Content-Length: 1\r\n\r\n"), 200) << method;
  }
}

TEST(RequestHead, ContentCodingsAreRefused) {
  EXPECT_EQ(status_of_post("Content-Encoding: identity\r\n"), 200);
  EXPECT_EQ(status_of_post("Content-Encoding: Identity, identity\r\n"), 200);
  for (const char* coding : {"gzip", "br", "BR", "x-gzip", "deflate", "zstd", "identity, br",
                             "br,identity", "%62r", "br;q=0", "*"}) {
    EXPECT_EQ(status_of_post(fmt::format("Content-Encoding: {}\r\n", coding)), 415) << coding;
    EXPECT_EQ(status_of_get(fmt::format("Content-Encoding: {}\r\n", coding)), 415) << coding;
  }
  EXPECT_EQ(status_of_post("Content-Encoding: identity\r\ncontent-encoding: br\r\n"), 415);
  EXPECT_THAT(
      library_text(taken("POST / HTTP/1.1\r\nHost: a\r\nContent-Encoding: identity\r\n\r\n")),
      Not(HasSubstr("Encoding")));
}

TEST(RequestHead, OtherExpectationsAreRefused) {
  EXPECT_EQ(status_of_post("Content-Length: 1\r\nExpect: 200-ok\r\n"), 417);
  EXPECT_EQ(status_of_post("Expect: 100-continue\r\nExpect: 100-continue\r\n"), 400);
  EXPECT_FALSE(taken("GET / HTTP/1.1\r\nHost: a\r\nExpect: 100-continue\r\n\r\n").expects_continue);
}

TEST(RequestHead, FieldsThatDecideAreThereOnce) {
  for (const char* name : {"Authorization", "Content-Type", "Origin", "Range", "Idempotency-Key"}) {
    EXPECT_EQ(status_of_get(fmt::format("{0}: a\r\n{0}: b\r\n", name)), 400) << name;
  }
}

TEST(RequestHead, TheLibraryGetsTheSentBytes) {
  const std::string text = library_text(
      taken("GET / HTTP/1.0\r\nX: a%0d%0aEvil: 1\r\nREMOTE_ADDR: 1.2.3.4\r\nUpgrade: h2c\r\n"
            "Connection: keep-alive, X\r\nTrailer: Content-Length\r\n\r\n"));
  // cpp-httplib 0.11 decodes percent escapes in values.
  EXPECT_EQ(text, "GET / HTTP/1.0\r\nX: a%250d%250aEvil: 1\r\nConnection: Keep-Alive\r\n\r\n");
}

TEST(RequestHead, GzipIsTheOnlyCodingOfAnswers) {
  const auto text_of = [](const std::string& codings) {
    return library_text(taken("GET / HTTP/1.1\r\nHost: a\r\n" + codings + "\r\n"));
  };
  const std::string plain = "GET / HTTP/1.1\r\nHost: a\r\n\r\n";
  const std::string packed = "GET / HTTP/1.1\r\nHost: a\r\nAccept-Encoding: gzip\r\n\r\n";
  for (const char* codings :
       {"", "br", "identity", "gzip;q=0", "br, gzip; q=0.000, deflate", "notgzip", "*"}) {
    EXPECT_EQ(text_of(fmt::format("Accept-Encoding: {}\r\n", codings)), plain) << codings;
  }
  for (const char* codings :
       {"gzip", "gzip, deflate, br, zstd", "br;q=1, GZIP;q=0.8", "x-gzip", "gzip;q=1"}) {
    EXPECT_EQ(text_of(fmt::format("accept-encoding: {}\r\n", codings)), packed) << codings;
  }
  EXPECT_EQ(text_of("Accept-Encoding: br\r\nAccept-Encoding: gzip\r\n"), packed);
}

TEST(RequestHead, BeginningsAreRefusedAtOnce) {
  const auto status = [](const std::string& bytes) { return check_head_start(bytes).status; };
  EXPECT_EQ(status("GE"), 0);
  EXPECT_EQ(status("GET / HTTP/1.1\r\nHost"), 0);
  EXPECT_EQ(status("GET / HTTP/1.1\r"), 0);
  EXPECT_EQ(status("\x16\x03\x01"), 400);  // TLS
  EXPECT_EQ(status("GET /\r\n"), 400);     // HTTP/0.9
  EXPECT_EQ(status("GET / HTTP/1.1\n"), 400);
  EXPECT_EQ(status("FOO / HTTP/1.1\r\n"), 501);
  EXPECT_EQ(status(std::string(kMaxLineBytes + 1, 'x')), 414);
}

}  // namespace
}  // namespace throng::server
