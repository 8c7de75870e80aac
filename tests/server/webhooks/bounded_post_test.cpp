#include "server/webhooks/bounded_post.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

namespace throng::server {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Takes one connection after the other and treats it as it likes.
class RawReceiver {
 public:
  using Treat = std::function<void(int connection, const std::atomic<bool>& ends)>;

  explicit RawReceiver(Treat treat) : treat_(std::move(treat)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof(address));
    ::listen(listener_, 8);
    socklen_t length = sizeof(address);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] {
      for (int connection = 0; (connection = ::accept(listener_, nullptr, nullptr)) >= 0;) {
        char block[4096];
        if (::recv(connection, block, sizeof(block), 0) > 0) treat_(connection, ends_);
        ::close(connection);
      }
    });
  }
  ~RawReceiver() {
    ends_ = true;
    ::shutdown(listener_, SHUT_RDWR);
    thread_.join();
    ::close(listener_);
  }
  RawReceiver(const RawReceiver&) = delete;
  RawReceiver& operator=(const RawReceiver&) = delete;

  std::string url(const std::string& scheme = "http") const {
    return scheme + "://127.0.0.1:" + std::to_string(port_) + "/hook?x=1";
  }

 private:
  Treat treat_;
  int listener_ = -1;
  int port_ = 0;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

void say(int connection, const std::string& text) {
  ::send(connection, text.data(), text.size(), MSG_NOSIGNAL);
}

RawReceiver saying(const std::string& text) {
  return RawReceiver([text](int connection, const auto&) { say(connection, text); });
}

PostResult post(const std::string& url, std::chrono::milliseconds timeout = 60s,
                const std::stop_token& stop = {}) {
  return bounded_post(url, {{"A", "b"}}, "{}", {.timeout = timeout, .allow_private = true}, stop);
}

/// Until the test ends, or for a minute: then the connection is closed, which is another error than
/// that of a time limit.
void wait_for_end(const std::atomic<bool>& ends) {
  const auto last = std::chrono::steady_clock::now() + 60s;
  while (!ends && std::chrono::steady_clock::now() < last) std::this_thread::sleep_for(5ms);
}

TEST(BoundedPost, TheStatusIsThatOfTheFinalAnswer) {
  const std::pair<const char*, int> answers[] = {
      {"HTTP/1.1 200 OK\r\nContent-Length: 9999999\r\n\r\n", 200},
      {"HTTP/1.0 204 No Content\r\n\r\n", 204},
      {"HTTP/1.1 302 Found\r\nLocation: http://169.254.169.254/\r\n\r\n", 302},
      {"HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 103 Early Hints\r\nA: b\r\n\r\n"
       "HTTP/1.1 503 No\r\n\r\n",
       503},
      {"HTTP/1.1 200\r\n\r\n", 200}};
  for (const auto& [text, status] : answers) {
    const RawReceiver receiver = saying(text);
    EXPECT_EQ(post(receiver.url()).status, status) << text;
  }
}

TEST(BoundedPost, FailedAnswersAreNamed) {
  for (const char* text : {"SSH-2.0-OpenSSH\r\n", "HTTP/1.1 2x0 OK\r\n\r\n", "HTTP/1.1\r\n\r\n",
                           "\r\n\r\n", "HTTP/1.1 200"}) {
    const RawReceiver receiver = saying(text);
    const PostResult result = post(receiver.url());
    EXPECT_EQ(result.status, 0) << text;
    EXPECT_NE(result.error, "") << text;
  }
  EXPECT_NE(post("http://127.0.0.1:1/").error, "");
  EXPECT_NE(post("http://no-such-host.invalid/").error, "");
}

TEST(BoundedPost, AHeadWithoutEndTakesNoMemory) {
  std::atomic<std::size_t> sent = 0;
  const RawReceiver receiver([&](int connection, const auto& ends) {
    const std::string block(1 << 16, 'x');
    while (!ends && ::send(connection, block.data(), block.size(), MSG_NOSIGNAL) > 0) {
      sent += block.size();
    }
  });
  EXPECT_NE(post(receiver.url()).error, "");
  EXPECT_LT(sent, 64U << 20U);
}

TEST(BoundedPost, InformationalAnswersWithoutEndAreCutOff) {
  const RawReceiver receiver([&](int connection, const auto& ends) {
    const std::string block = "HTTP/1.1 100 Continue\r\n\r\n";
    while (!ends && ::send(connection, block.data(), block.size(), MSG_NOSIGNAL) > 0) {
    }
  });
  EXPECT_THAT(post(receiver.url()).error, HasSubstr("too long a head"));
}

TEST(BoundedPost, ADrippingAnswerEndsInTime) {
  const RawReceiver receiver([](int connection, const auto& ends) {
    say(connection, "HTTP/1.1 100 Continue");
    for (int i = 0; i < 600 && !ends; ++i) {  // a minute
      say(connection, "x");
      std::this_thread::sleep_for(100ms);
    }
  });
  EXPECT_THAT(post(receiver.url(), 500ms).error, HasSubstr("no answer in time"));
}

TEST(BoundedPost, SilenceEndsInTimeAlsoBeforeTls) {
  for (const char* scheme : {"http", "https"}) {
    const RawReceiver receiver([](int, const auto& ends) { wait_for_end(ends); });
    EXPECT_THAT(post(receiver.url(scheme), 300ms).error, HasSubstr("no answer in time")) << scheme;
  }
}

TEST(BoundedPost, AStopEndsItAtOnce) {
  std::stop_source stop;
  const RawReceiver receiver([&](int, const auto& ends) {
    stop.request_stop();  // the request has come
    wait_for_end(ends);
  });
  EXPECT_THAT(post(receiver.url(), 600s, stop.get_token()).error, HasSubstr("the service ends"));
}

TEST(BoundedPost, TlsNeedsACertificateThatIsTrusted) {
  const RawReceiver plain = saying("HTTP/1.1 200 OK\r\n\r\n");
  const PostResult result = post(plain.url("https"));
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.error, "");
}

TEST(BoundedPost, PrivateAddressesAreNotCalled) {
  std::atomic<int> calls = 0;
  const RawReceiver receiver([&](int connection, const auto&) {
    ++calls;
    say(connection, "HTTP/1.1 200 OK\r\n\r\n");
  });
  std::string named = receiver.url();
  named.replace(named.find("127.0.0.1"), 9, "localhost");
  for (const std::string& url : {receiver.url(), named}) {
    const PostResult result = bounded_post(url, {}, "{}", {.allow_private = false}, {});
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.error, HasSubstr("private"));
  }
  EXPECT_EQ(calls, 0);
}

TEST(BoundedPost, UrlsAreReadStrictly) {
  for (const char* url :
       {"http://a", "https://a:1/", "http://[::1]:80/x", "http://a?q", "http://a.b:65535"}) {
    EXPECT_TRUE(is_callable_url(url)) << url;
  }
  for (const char* url :
       {"ftp://a", "http://", "http://:80", "http://a:0", "http://a:65536", "http://a:x",
        "http://a:80:80/", "http://[::1", "http://[::1]x", "http:///x", "http://user@a/"}) {
    EXPECT_FALSE(is_callable_url(url)) << url;
  }
}

}  // namespace
}  // namespace throng::server
