// Reads little-endian CDR, as clients of ROS 2 publish it; the inverse of formats/files/cdr.h.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/error.h"

namespace throng::live {

/// Takes the fields of one message in the order of its definition. All members throw InputError
/// that names the topic where the message ends too early.
class CdrReader {
 public:
  CdrReader(std::string_view bytes, std::string topic) : bytes_(bytes), topic_(std::move(topic)) {
    constexpr std::size_t kOrderAt = 1;
    take(kHeaderBytes);
    if (bytes_[0] != '\0' || bytes_[kOrderAt] != '\1') refuse("another encapsulation");
  }

  template <typename Number>
  Number number() {
    const std::size_t over = (at_ - kHeaderBytes) % sizeof(Number);
    if (over > 0) take(sizeof(Number) - over);
    Number value{};
    std::memcpy(&value, take(sizeof(Number)).data(), sizeof(Number));
    return value;
  }

  std::string_view text() { return take(number<std::uint32_t>()); }

 private:
  static constexpr std::size_t kHeaderBytes = 4;

  [[noreturn]] void refuse(const std::string& found) const {
    throw InputError({topic_, "", found, "a message in little-endian CDR with all its fields"});
  }
  std::string_view take(std::size_t count) {
    if (bytes_.size() - at_ < count)
      refuse("a message of " + std::to_string(bytes_.size()) + " bytes");
    const std::string_view taken = bytes_.substr(at_, count);
    at_ += count;
    return taken;
  }

  std::string_view bytes_;
  std::string topic_;
  std::size_t at_ = 0;
};

}  // namespace throng::live
