// Byte range that a client requests (RFC 9110, section 14).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace throng::server {

/// Bytes first..last, both included.
struct ByteRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
  bool operator==(const ByteRange&) const = default;
};

/// Answer to a range request: everything, a part, or that there is no such part.
struct RangeAnswer {
  enum class Kind { whole, part, unsatisfiable };
  Kind kind = Kind::whole;
  ByteRange part;
  bool operator==(const RangeAnswer&) const = default;
};

/// Reads the value of a Range header ("" for none) for a file of `size` bytes. `if_range` is the
/// If-Range header ("" for none): unless it is `etag`, the whole file is meant. More than one
/// range, and what is no range of bytes, is answered with the whole file, as the standard allows.
RangeAnswer range_answer(const std::string& range, const std::string& if_range,
                         const std::string& etag, std::int64_t size);

}  // namespace throng::server
