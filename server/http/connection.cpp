#include "server/http/connection.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

namespace throng::server {

namespace {

using std::chrono::milliseconds;

/// Whether the event comes in time; also true when the connection has broken.
bool waits_for(socket_t socket, short event, milliseconds timeout) {
  pollfd wait{socket, event, 0};
  int result = 0;
  do {
    result = ::poll(&wait, 1, static_cast<int>(std::max(timeout, milliseconds(0)).count()));
  } while (result < 0 && errno == EINTR);
  return result > 0;
}

using NameOf = int (*)(int, sockaddr*, socklen_t*);

void read_name(socket_t socket, NameOf to_string, std::string& ip, int& port) {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  if (to_string(socket, reinterpret_cast<sockaddr*>(&address), &length) != 0) return;
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

Connection::~Connection() {
  if (is_dropped_) {
    ::close(socket_);
  } else {
    close_gently(socket_, limits_->linger);
  }
}

bool Connection::receive(milliseconds timeout) {
  if (next_ == end_) next_ = end_ = 0;
  if (end_ == buffer_.size()) {
    std::memmove(buffer_.data(), buffer_.data() + next_, end_ - next_);
    end_ -= next_;
    next_ = 0;
  }
  if (!waits_for(socket_, POLLIN, timeout)) return false;
  ssize_t count = 0;
  do {
    count = ::recv(socket_, buffer_.data() + end_, buffer_.size() - end_, 0);
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  end_ += static_cast<std::size_t>(count);
  return true;
}

std::variant<RequestHead, HeadError, Connection::Ended> Connection::read_head() {
  constexpr std::string_view kEmptyLine = "\r\n";
  constexpr std::string_view kHeadEnd = "\r\n\r\n";
  const auto end = Clock::now() + limits_->head_time;
  bool may_skip = true;  // old clients end a body with an empty line that is not of it
  std::size_t searched = 0;
  while (true) {
    if (may_skip && pending().starts_with(kEmptyLine)) {
      next_ += kEmptyLine.size();
      may_skip = false;
    }
    const std::string_view bytes = pending();
    if (const auto at = bytes.find(kHeadEnd, searched); at != bytes.npos) {
      next_ += at + kHeadEnd.size();
      auto head = parse_request_head(bytes.substr(0, at + kHeadEnd.size()));
      if (auto* error = std::get_if<HeadError>(&head)) return std::move(*error);
      return std::get<RequestHead>(std::move(head));
    }
    if (!bytes.empty() && bytes != kEmptyLine.substr(0, 1)) {
      if (HeadError error = check_head_start(bytes); error.status != 0) return error;
    }
    searched = bytes.size() - std::min(bytes.size(), kHeadEnd.size() - 1);
    const auto left = std::chrono::ceil<milliseconds>(end - Clock::now());
    if (!receive(std::min(left, limits_->silence))) {
      if (Clock::now() < end || pending().empty()) return Ended{};
      return HeadError{408, "the request's head took too long"};
    }
  }
}

HeadError Connection::receive_chunks(RequestHead& head, std::size_t max_bytes,
                                     const std::function<bool(std::size_t)>& may_hold) {
  ChunkedBody& body = chunks_.emplace(max_bytes);
  awaits_continue_ = head.expects_continue;
  body_bytes_ = 0;
  began_ = Clock::now();
  while (!body.is_whole()) {
    if (!is_body_in_time() || (!has_pending() && !receive_body())) {
      return {408, "the request's body ended early or took too long"};
    }
    next_ += body.take(pending());
    body_bytes_ = body.bytes();
    if (body.error().status != 0) return body.error();
    if (!may_hold(body.bytes()))
      return {503, "other uploads take all the memory there is for them"};
  }
  head.content_length = body.bytes();
  head.expects_continue = false;
  return {0, ""};
}

void Connection::begin_request(const RequestHead& head) {
  head_ = library_text(head);
  head_next_ = 0;
  body_left_ = head.content_length;
  body_bytes_ = 0;
  awaits_continue_ = head.expects_continue;
  if (!head.is_chunked) chunks_.reset();
  began_ = Clock::now();
}

bool Connection::is_body_in_time() const {
  const std::chrono::duration<double> slow = Clock::now() - began_ - limits_->body_timeout;
  return static_cast<double>(body_bytes_) >= slow.count() * limits_->body_bytes_per_s;
}

// Bodies are read only once nothing speaks against it.
bool Connection::receive_body() {
  constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
  if (std::exchange(awaits_continue_, false) && !write_all(kContinue)) return false;
  return receive(limits_->silence);
}

ssize_t Connection::read(char* bytes, std::size_t size) {
  if (head_next_ < head_.size()) {
    const std::size_t given = std::min(size, head_.size() - head_next_);
    std::memcpy(bytes, head_.data() + head_next_, given);
    head_next_ += given;
    return static_cast<ssize_t>(given);
  }
  if (body_left_ == 0) return -1;
  if (chunks_) {
    const std::size_t given = chunks_->read(bytes, size);
    body_left_ -= given;
    return static_cast<ssize_t>(given);
  }
  if (!is_body_in_time() || (!has_pending() && !receive_body())) return -1;
  const std::size_t given = std::min({size, end_ - next_, body_left_});
  std::memcpy(bytes, buffer_.data() + next_, given);
  next_ += given;
  body_left_ -= given;
  body_bytes_ += given;
  return static_cast<ssize_t>(given);
}

bool Connection::write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(bytes.data(), bytes.size());
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool Connection::is_readable() const {
  return has_pending() || (chunks_ && body_left_ > 0) ||
         waits_for(socket_, POLLIN, limits_->silence);
}

bool Connection::is_writable() const {
  if (!waits_for(socket_, POLLOUT, limits_->stalled)) return false;
  if (!waits_for(socket_, POLLIN, milliseconds(0))) return true;
  char byte = 0;
  const ssize_t count = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

ssize_t Connection::write(const char* bytes, std::size_t size) {
  if (!waits_for(socket_, POLLOUT, limits_->stalled)) return -1;
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

void close_gently(socket_t socket, milliseconds linger) {
  constexpr std::size_t kMaxBytes = 8 << 20;
  ::shutdown(socket, SHUT_WR);
  std::array<char, 16 << 10> block{};
  const auto end = std::chrono::steady_clock::now() + linger;
  for (std::size_t seen = 0; seen < kMaxBytes;) {
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
