// Writer for MCAP recordings (mcap.dev, version 0): chunked, compressed with zstd, indexed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::formats {

/// Definition of a kind of messages.
struct McapSchema {
  std::string name;      ///< such as sensor_msgs/msg/Imu
  std::string encoding;  ///< of the text, such as ros2msg
  std::string text;
};

/// Settings of a recording.
struct McapOptions {
  std::string profile = "ros2";
  std::string message_encoding = "cdr";
  std::size_t chunk_bytes = std::size_t{1} << 22;  ///< uncompressed, at which a chunk is written
  /// Span of a chunk's messages, at which it is written, too; none: any.
  std::optional<std::uint64_t> chunk_ns = {};
  bool is_compressed = true;
};

/// A recording that is written message by message. Memory holds one chunk, and about 200 bytes for
/// each one that was written. Space for what closes the file is reserved before each chunk, so
/// that a full disk leaves a complete recording of the chunks until then. A process that is killed
/// leaves whole chunks without what closes the file: `mcap recover` makes a recording of them.
class McapFile {
 public:
  /// Creates or replaces the file. Throws EnvironmentError, as all members do, if it cannot be
  /// written; the message then says until which time the recording is complete.
  McapFile(std::filesystem::path path, McapOptions options = {});
  /// Closes what was not closed, as far as that can be written: without the messages of the last
  /// chunk.
  ~McapFile();
  McapFile(const McapFile&) = delete;
  McapFile& operator=(const McapFile&) = delete;

  /// Declares a topic; returns its number. Topics with equal schemas share one.
  std::uint16_t add_channel(const std::string& topic, const McapSchema& schema);

  /// Adds a message at a time, in ns from the recording's epoch. Times need not grow.
  void add(std::uint16_t channel, std::uint64_t time_ns, std::string_view message);

  /// Writes the last chunk, the summary and the footer. Of the other members only
  /// complete_until_ns() may be called afterwards.
  void close();

  /// The file holds all messages that were added before this time. Also after close() and after an
  /// error.
  std::uint64_t complete_until_ns() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace throng::formats
