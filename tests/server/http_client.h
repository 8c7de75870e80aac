// Clients of a server under test: a busy machine may take a minute to answer, and a request without
// an answer fails the test that made it.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "server/http/http.h"

namespace throng::server {

inline constexpr int kPatienceS = 60;

/// Requests have the names that they have in the library. Each returns an answer, or throws.
class HttpClient {
 public:
  explicit HttpClient(int port) : client_("127.0.0.1", port) {
    client_.set_connection_timeout(kPatienceS);
    client_.set_read_timeout(kPatienceS);
    client_.set_write_timeout(kPatienceS);
  }

  void set_keep_alive(bool on) { client_.set_keep_alive(on); }
  void set_decompress(bool on) { client_.set_decompress(on); }

  httplib::Result Get(const std::string& path, const httplib::Headers& headers = {}) {
    return answered("GET", path, client_.Get(path, headers));
  }
  /// Ends without an answer once `receive` returns false.
  void Get(const std::string& path, const httplib::Headers& headers,
           const httplib::ContentReceiver& receive) {
    answered("GET", path, client_.Get(path, headers, receive));
  }
  httplib::Result Head(const std::string& path) {
    return answered("HEAD", path, client_.Head(path));
  }
  httplib::Result Post(const std::string& path, const std::string& body, const std::string& type) {
    return answered("POST", path, client_.Post(path, body, type));
  }
  httplib::Result Post(const std::string& path, const httplib::Headers& headers,
                       const std::string& body, const std::string& type) {
    return answered("POST", path, client_.Post(path, headers, body, type));
  }
  httplib::Result Post(const std::string& path, const httplib::MultipartFormDataItems& items) {
    return answered("POST", path, client_.Post(path, items));
  }
  httplib::Result Post(const std::string& path, const httplib::Headers& headers,
                       const httplib::MultipartFormDataItems& items) {
    return answered("POST", path, client_.Post(path, headers, items));
  }
  httplib::Result Put(const std::string& path, const std::string& body, const std::string& type) {
    return answered("PUT", path, client_.Put(path, body, type));
  }
  httplib::Result Patch(const std::string& path, const std::string& body, const std::string& type) {
    return answered("PATCH", path, client_.Patch(path, body, type));
  }
  httplib::Result Patch(const std::string& path, const httplib::Headers& headers,
                        const std::string& body, const std::string& type) {
    return answered("PATCH", path, client_.Patch(path, headers, body, type));
  }
  httplib::Result Delete(const std::string& path, const httplib::Headers& headers = {}) {
    return answered("DELETE", path, client_.Delete(path, headers));
  }

 private:
  static httplib::Result answered(const char* method, const std::string& path,
                                  httplib::Result result) {
    if (result || result.error() == httplib::Error::Canceled) return result;
    const std::string what =
        std::string("no answer to ") + method + " " + path + ": " + to_string(result.error());
    ADD_FAILURE() << what;
    throw std::runtime_error(what);
  }

  httplib::Client client_;
};

/// A connection that sends bytes as they are.
class RawConnection {
 public:
  explicit RawConnection(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    const timeval patience{kPatienceS, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof(patience));
  }
  ~RawConnection() { ::close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  /// As much as the server takes.
  void send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  /// All that comes, to the first `end` in it, or until the server closes the connection.
  std::string read(std::string_view end = {}) const {
    std::string answer;
    char block[4096];
    while (end.empty() || answer.find(end) == std::string::npos) {
      const ssize_t count = ::recv(socket_, block, sizeof(block), 0);
      if (count < 0 && errno == EAGAIN) ADD_FAILURE() << "the server goes on after: " << answer;
      if (count <= 0) break;
      answer.append(block, static_cast<std::size_t>(count));
    }
    return answer;
  }

 private:
  int socket_;
};

}  // namespace throng::server
