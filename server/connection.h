// A client's connection with bounds that cpp-httplib lacks: a request's headers have so many bytes
// and so much time, and its body does not trickle in for ever.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include "server/http.h"

namespace throng::server {

struct ConnectionLimits {
  std::size_t header_bytes = 64 << 10;           ///< of a request's first line and headers together
  std::chrono::milliseconds header_time{5'000};  ///< from their first byte to their last
  std::chrono::milliseconds silence{10'000};     ///< in which nothing arrives
  std::chrono::milliseconds stalled{30'000};     ///< in which nothing can be sent
  /// A body may be slower than this for so long.
  double body_bytes_per_s = 16'384;
  std::chrono::milliseconds body_patience{10'000};
};

class Connection : public httplib::Stream {
 public:
  Connection(socket_t socket, const ConnectionLimits& limits) : socket_(socket), limits_(limits) {}

  /// What arrives from now on is a new request.
  void begin_request();
  /// Whether bytes wait that have been received with the last request.
  bool has_pending() const { return next_ < end_; }

  bool is_readable() const override;
  /// Whether the client still listens.
  bool is_writable() const override;
  /// -1 once a bound has been broken, and for broken connections.
  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool receive();
  bool is_within_bounds() const;
  std::chrono::milliseconds patience() const;
  void count(const char* bytes, std::size_t size);

  socket_t socket_;
  const ConnectionLimits& limits_;
  std::array<char, 16 << 10> buffer_{};
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  Clock::time_point began_;       ///< the headers, then the body
  std::size_t header_bytes_ = 0;  ///< of this request, handed on so far
  std::size_t body_bytes_ = 0;
  std::size_t line_bytes_ = 0;  ///< of the header's line, without its end
  bool in_header_ = true;
};

/// Ends a connection so that the last answer arrives though the client still sends: closing with
/// unread bytes would make its system throw the answer away.
void close_gently(socket_t socket);

}  // namespace throng::server
