// Parser for byte ranges of requests (RFC 9110, section 14).
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

/// Answer to a range request: the whole file, a part, or status 416.
struct RangeAnswer {
  enum class Kind { whole, part, unsatisfiable };
  Kind kind = Kind::whole;
  ByteRange part;
  bool operator==(const RangeAnswer&) const = default;
};

/// Interprets a Range header ("" for none) for a file of `size` bytes. `if_range` is the If-Range
/// header ("" for none); if it differs from `etag`, the answer is the whole file. So is the answer
/// to several ranges and to other units than bytes, as the standard permits.
RangeAnswer range_answer(const std::string& range, const std::string& if_range,
                         const std::string& etag, std::int64_t size);

}  // namespace throng::server
