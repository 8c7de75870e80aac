// Messages of a live flight, from its process through the service to the page: the type, the number
// of bytes, the bytes. docs/studio.md has what they hold.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace throng::live {

enum class MessageType : char {
  hello = 'H',    ///< JSON, first: the scenario, people, drones
  state = 'S',    ///< binary, after each step: where everybody is
  image = 'P',    ///< binary: a drone's camera
  event = 'V',    ///< JSON: a collision, a low battery
  result = 'R',   ///< JSON, last: how the flight is repeated
  failure = 'E',  ///< JSON, last: kind, message, problems
  alive = 'A',    ///< nothing; of the service
};

struct Message {
  MessageType type = MessageType::alive;
  std::string bytes;
};

/// One byte for the type, the length in four (little-endian), the bytes.
std::string framed(const Message& message);

/// Finds the messages in a stream of bytes.
class MessageReader {
 public:
  void add(std::string_view bytes) { pending_ += bytes; }
  /// The next whole message; nothing until more has arrived. Throws EnvironmentError for bytes that
  /// are no message.
  std::optional<Message> next();

 private:
  std::string pending_;
  std::size_t done_ = 0;  ///< bytes of pending_ that have been handed over
};

/// A number of a message, little-endian.
template <typename Number>
void append_number(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));  // NOLINT
}

}  // namespace throng::live
