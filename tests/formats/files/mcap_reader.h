// Reads MCAP recordings byte by byte, as their specification has it.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "formats/files/mcap_file.h"

namespace throng::formats::mcap {

inline const McapSchema kText{"std_msgs/msg/String", "ros2msg", "string data\n"};

/// Reads little-endian values from bytes.
class Bytes {
 public:
  explicit Bytes(std::string bytes) : bytes_(std::move(bytes)) {}

  template <typename Number>
  Number take() {
    Number number;
    std::memcpy(&number, bytes_.data() + at_, sizeof(Number));
    at_ += sizeof(Number);
    return number;
  }
  std::string take_text() { return take_bytes(take<std::uint32_t>()); }
  std::string take_bytes(std::size_t count) {
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  bool is_at_end() const { return at_ >= bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

struct Record {
  int opcode = 0;
  std::uint64_t at = 0;
  std::string content;
};

inline std::vector<Record> read_records(const std::string& bytes, std::uint64_t from = 0) {
  std::vector<Record> records;
  Bytes reader(bytes);
  std::uint64_t at = from;
  while (!reader.is_at_end()) {
    Record record;
    record.opcode = reader.take<std::uint8_t>();
    record.at = at;
    const auto size = reader.take<std::uint64_t>();
    record.content = reader.take_bytes(size);
    at += 9 + size;
    records.push_back(std::move(record));
  }
  return records;
}

inline constexpr std::size_t kMagicBytes = 8;

inline std::string without_magic(const std::string& file) {
  EXPECT_EQ(file.substr(0, kMagicBytes), std::string("\x89MCAP0\r\n", 8));
  EXPECT_EQ(file.substr(file.size() - kMagicBytes), file.substr(0, kMagicBytes));
  return file.substr(kMagicBytes, file.size() - 2 * kMagicBytes);
}

struct Message {
  std::uint16_t channel;
  std::uint32_t sequence;
  std::uint64_t time_ns;
  std::string data;
};

/// The messages of a chunk's records; checks the checksum.
inline std::vector<Message> read_chunk(const std::string& content) {
  Bytes chunk(content);
  chunk.take<std::uint64_t>();
  chunk.take<std::uint64_t>();
  std::string records(chunk.take<std::uint64_t>(), '\0');
  const auto checksum = chunk.take<std::uint32_t>();
  const bool is_packed = chunk.take_text() == "zstd";
  const std::string packed = chunk.take_bytes(chunk.take<std::uint64_t>());
  if (is_packed) {
    EXPECT_EQ(ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size()),
              records.size());
  } else {
    records = packed;
  }
  EXPECT_EQ(
      ::crc32(0, reinterpret_cast<const Bytef*>(records.data()), static_cast<uInt>(records.size())),
      checksum);
  std::vector<Message> messages;
  for (const Record& record : read_records(records)) {
    if (record.opcode != 5) continue;
    Bytes message(record.content);
    Message read{message.take<std::uint16_t>(), message.take<std::uint32_t>(),
                 message.take<std::uint64_t>(), ""};
    message.take<std::uint64_t>();
    read.data = message.take_bytes(record.content.size() - 22);
    messages.push_back(std::move(read));
  }
  return messages;
}

inline std::vector<Message> read_messages(const std::string& file) {
  std::vector<Message> messages;
  for (const Record& record : read_records(without_magic(file))) {
    if (record.opcode != 6) continue;
    for (Message& message : read_chunk(record.content)) messages.push_back(std::move(message));
  }
  return messages;
}

}  // namespace throng::formats::mcap
