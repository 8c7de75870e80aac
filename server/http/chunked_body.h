// Body of a request in the chunked transfer coding (RFC 9112, 7.1), for clients that do not know
// its length beforehand. As with heads, whatever two parsers could read differently is refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "server/http/request_head.h"

namespace throng::server {

/// Decodes a body while it arrives, and then returns its bytes. Extensions and trailers are checked
/// and dropped.
class ChunkedBody {
 public:
  /// `max_bytes` limits the decoded body.
  explicit ChunkedBody(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Decodes received bytes, up to the body's end or the first error, and returns the number of
  /// bytes that belong to the body.
  std::size_t take(std::string_view received);
  /// Whether the body's end, behind the trailers, has been received.
  bool is_whole() const { return state_ == State::whole; }
  /// Status 0 if there is no error; 400 for what is malformed, 413 for a body above the limit,
  /// known from the size of the chunk that exceeds it, 431 for long trailers.
  const HeadError& error() const { return error_; }
  /// Decoded bytes so far.
  std::size_t bytes() const { return bytes_; }

  /// Moves decoded bytes to `to`; returns their number.
  std::size_t read(char* to, std::size_t size);

 private:
  enum class State : std::uint8_t { size, data, data_end, trailer, whole };

  void take_data(std::string_view data);
  void take_line_char(char c);
  void end_line();
  void read_size();
  void fail(int status, std::string detail) { error_ = {status, std::move(detail)}; }

  std::size_t max_bytes_;
  State state_ = State::size;
  HeadError error_{0, ""};
  std::string line_;                ///< the unfinished line
  std::size_t left_ = 0;            ///< of the chunk
  std::size_t bytes_ = 0;           ///< decoded
  std::size_t extensions_ = 0;      ///< bytes of extensions
  std::size_t trailers_ = 0;        ///< bytes of trailers
  std::deque<std::string> blocks_;  ///< decoded and not yet read
  std::size_t next_ = 0;            ///< in the first block
};

}  // namespace throng::server
