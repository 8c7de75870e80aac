#include "server/http/chunked_body.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace throng::server {
namespace {

constexpr std::size_t kMaxBytes = 1000;

struct Decoded {
  int status = 0;
  bool is_whole = false;
  std::string body;
  std::size_t taken = 0;

  bool operator==(const Decoded&) const = default;
};

/// Decodes bytes that arrive in pieces of this size.
Decoded decoded(std::string_view bytes, std::size_t piece = std::string_view::npos) {
  ChunkedBody body(kMaxBytes);
  Decoded result;
  while (result.taken < bytes.size() && !body.is_whole() && body.error().status == 0) {
    result.taken += body.take(bytes.substr(result.taken, piece));
  }
  result.status = body.error().status;
  result.is_whole = body.is_whole();
  std::string block(7, '\0');
  while (const std::size_t count = body.read(block.data(), block.size())) {
    result.body.append(block, 0, count);
  }
  EXPECT_EQ(result.body.size(), body.bytes());
  return result;
}

int read_status(std::string_view bytes) {
  const Decoded whole = decoded(bytes);
  for (const std::size_t piece : {1, 2, 3, 5}) {
    EXPECT_EQ(decoded(bytes, piece).status, whole.status) << bytes;
    EXPECT_EQ(decoded(bytes, piece).body, whole.body) << bytes;
  }
  return whole.status;
}

TEST(ChunkedBody, ChunksAreOneBody) {
  for (const std::string text : {
           "5\r\nhello\r\n6\r\n world\r\n0\r\n\r\n",
           "b\r\nhello world\r\n0\r\n\r\n",
           "000B\r\nhello world\r\n000\r\n\r\n",
           "5;a\r\nhello\r\n6 ; b=\"c;d\"\r\n world\r\n0;e\r\n\r\n",
           "5\r\nhello\r\n6\r\n world\r\n0\r\nX-Sum: 7\r\nContent-Length: 99\r\n\r\n",
           "1\r\nh\r\n1\r\ne\r\n9\r\nllo world\r\n0\r\n\r\n",
       }) {
    for (const std::size_t piece : {1UL, 2UL, 7UL, text.size() + 40}) {
      const Decoded body = decoded(text + "GET / HTTP/1.1\r\n", piece);
      EXPECT_EQ(body.body, "hello world") << text;
      EXPECT_TRUE(body.is_whole && body.status == 0) << text;
      EXPECT_EQ(body.taken, text.size()) << "what follows is the next request: " << text;
    }
  }
  EXPECT_TRUE(decoded("0\r\n\r\n").is_whole);
  // Line ends and NUL are data like other bytes.
  const std::string binary("4\r\n\r\n\0\n\r\n0\r\n\r\n", 14);
  EXPECT_EQ(decoded(binary).body, std::string("\r\n\0\n", 4));
}

TEST(ChunkedBody, UnfinishedOnesAreNotWhole) {
  const std::string text = "5;x\r\nhello\r\n0\r\nA: b\r\n\r\n";
  for (std::size_t size = 0; size < text.size(); ++size) {
    const Decoded body = decoded(std::string_view(text).substr(0, size));
    EXPECT_FALSE(body.is_whole) << size;
    EXPECT_EQ(body.status, 0) << size;
  }
}

TEST(ChunkedBody, AmbiguousOnesAreRefused) {
  for (const std::string text : {"\r\n",
                                 "0x5\r\nhello",
                                 "+5\r\nhello",
                                 "-5\r\n",
                                 "-0\r\n\r\n",
                                 " 5\r\nhello",
                                 "5 \r\nhello",
                                 "5\t\r\n",
                                 "5 5\r\n",
                                 "5,5\r\n",
                                 "5.0\r\n",
                                 "g\r\n",
                                 ";a\r\n",
                                 "5\nhello",
                                 "5\rhello",
                                 "5\r\rhello",
                                 "5\r\nhello\n",
                                 "5\r\nhello!\r\n",
                                 "5\r\nhell\r\n0\r\n\r\n",
                                 "5\r\nhello0\r\n",
                                 "5;a\x01\r\n",
                                 "5;a\x7f\r\n",
                                 "5;a=\"\rb\"\r\n",
                                 "5;a\nb\r\n",
                                 "5a;\x0b\r\n",
                                 "5x\r\n",
                                 "0000000000000005\r\n",
                                 "ffffffffffffffff\r\n",
                                 "fffffffffffffffff\r\n",
                                 "10000000000000000\r\n",
                                 "0\r\n X: folded\r\n\r\n",
                                 "0\r\nX : y\r\n\r\n",
                                 "0\r\nno colon\r\n",
                                 "0\r\nX: y\n\r\n",
                                 "0\r\n\n"}) {
    EXPECT_EQ(read_status(text), 400) << text;
  }
  EXPECT_EQ(read_status(std::string("5\0\r\n", 4)), 400);
  EXPECT_EQ(read_status(std::string("0\r\nX: \0\r\n", 9)), 400);
}

TEST(ChunkedBody, LimitsHold) {
  EXPECT_EQ(read_status(fmt::format("{:x}\r\n", kMaxBytes)), 0);
  EXPECT_EQ(read_status(fmt::format("{:x}\r\n", kMaxBytes + 1)), 413) << "before the chunk comes";
  EXPECT_EQ(read_status("fffffffffffffff\r\n"), 413);
  const std::string half = fmt::format("{:x}\r\n{}\r\n", kMaxBytes / 2, std::string(500, 'x'));
  EXPECT_EQ(read_status(half + half + "0\r\n\r\n"), 0);
  EXPECT_EQ(read_status(half + half + "1\r\nx"), 413);
  EXPECT_EQ(read_status("1;" + std::string(9000, 'x')), 400);
  std::string extensions;
  for (int i = 0; i < 20; ++i) extensions += "1;" + std::string(999, 'x') + "\r\ny\r\n";
  EXPECT_EQ(read_status(extensions), 400);
  EXPECT_EQ(read_status("0\r\nX: " + std::string(9000, 'x')), 431);
  std::string trailers = "0\r\n";
  for (int i = 0; i < 70; ++i) trailers += "X: " + std::string(1000, 'x') + "\r\n";
  EXPECT_EQ(read_status(trailers), 431);
}

}  // namespace
}  // namespace throng::server
