#include "server/connection.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace throng::server {

namespace {

using std::chrono::milliseconds;

/// Whether the event comes in time; also true when the connection has broken.
bool waits_for(socket_t socket, short event, milliseconds patience) {
  pollfd wait{socket, event, 0};
  int result = 0;
  do {
    result = ::poll(&wait, 1, static_cast<int>(std::max(patience, milliseconds(0)).count()));
  } while (result < 0 && errno == EINTR);
  return result > 0;
}

using NameOf = int (*)(int, sockaddr*, socklen_t*);

void read_name(socket_t socket, NameOf name_of, std::string& ip, int& port) {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  if (name_of(socket, reinterpret_cast<sockaddr*>(&address), &length) != 0) return;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  if (::getnameinfo(reinterpret_cast<const sockaddr*>(&address), length, host.data(), host.size(),
                    service.data(), service.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return;
  }
  ip = host.data();
  port = std::atoi(service.data());
}

}  // namespace

void Connection::begin_request() {
  began_ = Clock::now();
  header_bytes_ = 0;
  body_bytes_ = 0;
  line_bytes_ = 0;
  in_header_ = true;
}

milliseconds Connection::patience() const {
  if (!in_header_) return limits_.silence;
  const auto left =
      limits_.header_time - std::chrono::duration_cast<milliseconds>(Clock::now() - began_);
  return std::min(limits_.silence, left);
}

bool Connection::is_within_bounds() const {
  const std::chrono::duration<double> passed = Clock::now() - began_;
  if (in_header_) return header_bytes_ <= limits_.header_bytes && passed <= limits_.header_time;
  const std::chrono::duration<double> slow = passed - limits_.body_patience;
  return static_cast<double>(body_bytes_) >= slow.count() * limits_.body_bytes_per_s;
}

bool Connection::receive() {
  if (!waits_for(socket_, POLLIN, patience())) return false;
  ssize_t count = 0;
  do {
    count = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  next_ = 0;
  end_ = static_cast<std::size_t>(count);
  return true;
}

// The headers end with the first line that is empty, as the library sees it.
void Connection::count(const char* bytes, std::size_t size) {
  std::size_t i = 0;
  for (; i < size && in_header_; ++i) {
    ++header_bytes_;
    if (bytes[i] == '\n') {
      if (line_bytes_ == 0) {
        in_header_ = false;
        began_ = Clock::now();
      }
      line_bytes_ = 0;
    } else if (bytes[i] != '\r') {
      ++line_bytes_;
    }
  }
  body_bytes_ += size - i;
}

ssize_t Connection::read(char* bytes, std::size_t size) {
  if (!is_within_bounds()) return -1;
  if (!has_pending() && !receive()) return -1;
  const std::size_t given = std::min(size, end_ - next_);
  std::memcpy(bytes, buffer_.data() + next_, given);
  next_ += given;
  count(bytes, given);
  return static_cast<ssize_t>(given);
}

bool Connection::is_readable() const {
  return has_pending() || waits_for(socket_, POLLIN, patience());
}

bool Connection::is_writable() const {
  if (!waits_for(socket_, POLLOUT, limits_.stalled)) return false;
  if (!waits_for(socket_, POLLIN, milliseconds(0))) return true;
  char byte = 0;
  const ssize_t count = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

ssize_t Connection::write(const char* bytes, std::size_t size) {
  if (!waits_for(socket_, POLLOUT, limits_.stalled)) return -1;
  ssize_t count = 0;
  do {
    count = ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  } while (count < 0 && errno == EINTR);
  return count < 0 && errno == EAGAIN ? 0 : count;
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  read_name(socket_, &::getpeername, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  read_name(socket_, &::getsockname, ip, port);
}

void close_gently(socket_t socket) {
  constexpr std::size_t kMostBytes = 8 << 20;
  constexpr milliseconds kLongest(2'000);
  ::shutdown(socket, SHUT_WR);
  std::array<char, 16 << 10> block{};
  const auto end = std::chrono::steady_clock::now() + kLongest;
  for (std::size_t seen = 0; seen < kMostBytes;) {
    const auto left =
        std::chrono::duration_cast<milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0 || !waits_for(socket, POLLIN, left)) break;
    const ssize_t count = ::recv(socket, block.data(), block.size(), 0);
    if (count <= 0) break;
    seen += static_cast<std::size_t>(count);
  }
  ::close(socket);
}

}  // namespace throng::server
