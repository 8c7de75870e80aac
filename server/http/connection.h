// Filter between a client's socket and cpp-httplib, whose parser is lenient. It reads a request's
// head from the socket, checks it (server/http/request_head.h), and passes a canonical head and the
// body to the library. The library gets only bytes of this request; if it leaves some unread, the
// connection cannot be used for another request. Heads and bodies have limits in size and time.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "server/http/chunked_body.h"
#include "server/http/connection_limits.h"
#include "server/http/http.h"
#include "server/http/request_head.h"

namespace throng::server {

/// One client's connection, whose socket it owns: its destructor closes it by close_gently(). The
/// limits must outlive it.
class Connection : public httplib::Stream {
 public:
  Connection(socket_t socket, const ConnectionLimits& limits) : socket_(socket), limits_(&limits) {}
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Makes the destructor close the socket at once: nothing has been received that was not
  /// answered.
  void drop() { is_dropped_ = true; }
  /// Sets the limits from now on; they must outlive this object.
  void use_limits(const ConnectionLimits& limits) { limits_ = &limits; }

  /// The connection is closed or broken.
  struct Ended {};
  /// Reads the next request's head from the socket.
  std::variant<RequestHead, HeadError, Ended> read_head();
  /// Receives the body of a head that is_chunked, which the library gets with its length: sets
  /// content_length. `may_hold` is asked for the bytes that are held so far. Returns an error's
  /// status, 408 also for connections that end, or 0.
  HeadError receive_chunks(RequestHead& head, std::size_t max_bytes,
                           const std::function<bool(std::size_t)>& may_hold);
  /// Makes read() return this request, head and body.
  void begin_request(const RequestHead& head);
  /// Whether the library has read the whole request, so that another one may follow.
  bool is_consumed() const { return head_next_ == head_.size() && body_left_ == 0; }
  /// Whether bytes after the last request have been received.
  bool has_pending() const { return next_ < end_; }
  /// Sends all bytes; returns false if the connection breaks.
  bool write_all(std::string_view bytes);

  bool is_readable() const override;
  /// Whether the client still accepts bytes.
  bool is_writable() const override;
  /// Returns -1 at the request's end, after a limit was exceeded, and for broken connections.
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
  bool receive_body();

  socket_t socket_;
  const ConnectionLimits* limits_;
  std::array<char, kMaxHeadBytes> buffer_{};  ///< received bytes; [next_, end_) are unread
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::string head_;  ///< canonical text for the library
  std::size_t head_next_ = 0;
  std::size_t body_left_ = 0;          ///< bytes of the body that the library has not read yet
  std::size_t body_bytes_ = 0;         ///< bytes of the body that it has read
  std::optional<ChunkedBody> chunks_;  ///< the body, if it came in chunks
  bool awaits_continue_ = false;
  bool is_dropped_ = false;
  Clock::time_point began_;  ///< start of the head, then of the body
};

/// Closes a connection so that the last response arrives even if the client still sends: a close
/// with unread bytes resets the connection, and the client's system would discard the response.
void close_gently(socket_t socket, std::chrono::milliseconds linger);

}  // namespace throng::server
