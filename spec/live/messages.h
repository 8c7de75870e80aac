// Messages of a live flight, which its process sends through the service to the browser. A message
// is its type, its length and its bytes; docs/studio.md describes their content.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

/// Appends a number's bytes, little-endian (the program runs on little-endian machines only).
template <typename Number>
void append_number(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));  // NOLINT
}

}  // namespace throng::live
