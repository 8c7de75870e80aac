// Messages of a live flight, which its process sends through the service to the browser. A message
// is its type, its length and its bytes; docs/studio.md describes their content.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace throng::live {

enum class MessageType : char {
  hello = 'H',    ///< JSON, first: the scenario, people, drones
  state = 'S',    ///< binary, after each step: positions of people and drones
  image = 'P',    ///< binary: an image of a drone's camera
  event = 'V',    ///< JSON: an event such as a collision or a low battery
  result = 'R',   ///< JSON, last: the result, with the job that repeats the flight
  failure = 'E',  ///< JSON, last: kind, message, problems
  alive = 'A',    ///< empty; a heartbeat of the service
};

/// The types with their names in other languages.
inline constexpr std::array<std::pair<MessageType, std::string_view>, 7> kMessageTypes = {
    {{MessageType::hello, "hello"},
     {MessageType::state, "state"},
     {MessageType::image, "image"},
     {MessageType::event, "event"},
     {MessageType::result, "result"},
     {MessageType::failure, "failure"},
     {MessageType::alive, "alive"}}};

/// Most bytes of a message.
inline constexpr std::uint32_t kMaxMessageBytes = 64U << 20U;

/// A message without its length.
struct Message {
  MessageType type = MessageType::alive;
  std::string bytes;
};

/// Name of a flight's recording in its folder.
inline constexpr const char* kRecordingFile = "flight.mcap";

/// Serializes a message: one byte of type, four bytes of length (little-endian), the bytes.
std::string framed(const Message& message);

/// Splits a stream of bytes into messages.
class MessageReader {
 public:
  void add(std::string_view bytes) { pending_ += bytes; }
  /// Returns the next message, or nothing if it is incomplete. Throws EnvironmentError for an
  /// unknown type or a length above 64 MiB.
  std::optional<Message> next();

 private:
  std::string pending_;
  std::size_t done_ = 0;  ///< number of bytes of pending_ that next() has returned
};

/// Appends the bytes of a number, or of a record without padding, little-endian (the program runs
/// on little-endian machines only).
template <typename Value>
void append_value(std::string& bytes, const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));  // NOLINT
}

}  // namespace throng::live
