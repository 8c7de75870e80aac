#include "spec/live/messages.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

#include "base/error.h"

namespace throng::live {

static_assert(std::endian::native == std::endian::little, "messages are copied as they lie");

namespace {

constexpr std::size_t kHeadBytes = 5;  // type and length

bool is_type(char byte) {
  return std::any_of(kMessageTypes.begin(), kMessageTypes.end(),
                     [&](const auto& row) { return static_cast<char>(row.first) == byte; });
}

}  // namespace

std::string framed(const Message& message) {
  std::string bytes;
  bytes.reserve(kHeadBytes + message.bytes.size());
  bytes += static_cast<char>(message.type);
  append_value(bytes, static_cast<std::uint32_t>(message.bytes.size()));
  bytes += message.bytes;
  return bytes;
}

std::optional<Message> MessageReader::next() {
  const std::string_view rest = std::string_view(pending_).substr(done_);
  if (rest.size() < kHeadBytes) {
    pending_.erase(0, done_);
    done_ = 0;
    return std::nullopt;
  }
  std::uint32_t length = 0;
  std::memcpy(&length, rest.data() + 1, sizeof(length));
  if (!is_type(rest.front()) || length > kMaxMessageBytes) {
    throw EnvironmentError("a live flight sent what is no message");
  }
  if (rest.size() < kHeadBytes + length) {
    pending_.erase(0, done_);
    done_ = 0;
    return std::nullopt;
  }
  done_ += kHeadBytes + length;
  return Message{static_cast<MessageType>(rest.front()),
                 std::string(rest.substr(kHeadBytes, length))};
}

}  // namespace throng::live
