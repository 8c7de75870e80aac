// The filter between a client's socket and cpp-httplib, which reads requests loosely. This class
// reads a request's head from the socket, has it checked (server/http/request_head.h), and hands
// the library a head and a body that cannot be misread: the library gets no byte that is not of
// this request, and after it has left one unread the connection is of no more use. Heads and bodies
// have limits in bytes and in time.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <variant>

#include "server/http/connection_limits.h"
#include "server/http/http.h"
#include "server/http/request_head.h"

namespace throng::server {

class Connection : public httplib::Stream {
 public:
  Connection(socket_t socket, const ConnectionLimits& limits) : socket_(socket), limits_(limits) {}

  /// Nothing can be read or sent any more.
  struct Ended {};
  /// Reads the next request's head from the socket.
  std::variant<RequestHead, HeadError, Ended> read_head();
  /// From now on the library reads this request, its body included.
  void begin_request(const RequestHead& head);
  /// Whether the library has read the request to its end, so that another may follow.
  bool is_consumed() const { return head_next_ == head_.size() && body_left_ == 0; }
  /// Whether bytes wait that have been received with the last request.
  bool has_pending() const { return next_ < end_; }
  /// False once the connection has broken.
  bool write_all(std::string_view bytes);

  bool is_readable() const override;
  /// Whether the client still listens.
  bool is_writable() const override;
  /// -1 at the request's end, once a bound has been broken, and for broken connections.
  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool receive(std::chrono::milliseconds timeout);
  std::string_view pending() const { return {buffer_.data() + next_, end_ - next_}; }
  bool is_body_in_time() const;

  socket_t socket_;
  const ConnectionLimits& limits_;
  std::array<char, kMaxHeadBytes> buffer_{};  ///< received; [next_, end_) has not been handed on
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::string head_;  ///< as the library reads it
  std::size_t head_next_ = 0;
  std::size_t body_left_ = 0;   ///< bytes that the library has not read yet
  std::size_t body_bytes_ = 0;  ///< that it has read
  bool awaits_continue_ = false;
  Clock::time_point began_;  ///< the head, then the body
};

/// Ends a connection so that the last answer arrives though the client still sends: closing with
/// unread bytes would make its system throw the answer away.
void close_gently(socket_t socket);

}  // namespace throng::server
