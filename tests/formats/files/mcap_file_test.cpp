// MCAP recordings, read byte by byte here, and by @mcap/core in tests/cli/test_recordings.py.
#include "formats/files/mcap_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <csignal>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "formats/files/ros_messages.h"
#include "tests/formats/files/mcap_reader.h"
#include "tests/world/temporary_folder.h"

namespace throng::formats::mcap {
namespace {

TEST(McapFile, HoldsWhatWasAdded) {
  const throng::testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  McapFile file(path, {.chunk_bytes = 200});
  const std::uint16_t a = file.add_channel("/a", kText);
  const std::uint16_t b = file.add_channel("/b", kText);
  for (std::uint64_t i = 0; i < 20; ++i) {
    file.add(i % 3 == 0 ? b : a, 1000 * i, "message " + std::to_string(i));
  }
  file.close();
  const std::vector<Message> messages = read_messages(read_file(path));
  ASSERT_EQ(messages.size(), 20U);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].channel, i % 3 == 0 ? b : a);
    EXPECT_EQ(messages[i].time_ns, 1000 * i);
    EXPECT_EQ(messages[i].data, "message " + std::to_string(i));
  }
}

TEST(McapFile, SummaryLeadsToEachMessage) {
  const throng::testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  McapFile file(path, {.chunk_bytes = 200});
  const std::uint16_t a = file.add_channel("/a", kText);
  file.add_channel("/never", kText);
  for (std::uint64_t i = 0; i < 20; ++i) file.add(a, 1000 * (20 - i), "message");
  file.close();
  const std::string bytes = read_file(path);
  Bytes footer(bytes.substr(bytes.size() - 28, 20));
  const auto summary_at = footer.take<std::uint64_t>();
  footer.take<std::uint64_t>();
  const auto checksum = footer.take<std::uint32_t>();
  const std::string covered = bytes.substr(summary_at, bytes.size() - 12 - summary_at);
  EXPECT_EQ(
      ::crc32(0, reinterpret_cast<const Bytef*>(covered.data()), static_cast<uInt>(covered.size())),
      checksum);
  std::map<int, int> counts;
  const std::string summary = bytes.substr(summary_at, bytes.size() - kMagicBytes - summary_at);
  for (const Record& record : read_records(summary, summary_at)) {
    ++counts[record.opcode];
    if (record.opcode == 14) {
      Bytes offset(record.content);
      const auto opcode = offset.take<std::uint8_t>();
      EXPECT_EQ(static_cast<std::uint8_t>(bytes.at(offset.take<std::uint64_t>())), opcode);
    }
    if (record.opcode != 8) continue;
    Bytes index(record.content);
    const auto from_ns = index.take<std::uint64_t>();
    const auto to_ns = index.take<std::uint64_t>();
    const auto chunk_at = index.take<std::uint64_t>();
    const auto chunk_size = index.take<std::uint64_t>();
    for (const Message& message : read_chunk(bytes.substr(chunk_at + 9, chunk_size - 9))) {
      EXPECT_GE(message.time_ns, from_ns);
      EXPECT_LE(message.time_ns, to_ns);
    }
    EXPECT_EQ(bytes.at(chunk_at + chunk_size), 7) << "an index of messages follows";
  }
  EXPECT_EQ(counts[3], 1) << "channels share their schema";
  EXPECT_EQ(counts[4], 2);
  EXPECT_EQ(counts[11], 1);
  EXPECT_GT(counts[8], 3);
}

/// As a disk that is full does, within a limit of this process for files.
TEST(McapFile, FullDiskLeavesACompleteRecording) {
  const throng::testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{300'000, before.rlim_max};
  McapFile file(path, {.chunk_bytes = 40'000, .is_compressed = false});
  const std::uint16_t a = file.add_channel("/a", kText);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::string what;
  std::uint64_t added = 0;
  try {
    for (; added < 1000; ++added) file.add(a, added * 1'000'000, std::string(10'000, 'x'));
  } catch (const EnvironmentError& error) {
    what = error.what();
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  const std::vector<Message> messages = read_messages(read_file(path));
  ASSERT_GT(messages.size(), 20U);
  EXPECT_LE(messages.size() + 4, added + 1) << "the last chunk is missing";
  EXPECT_THAT(
      what, ::testing::HasSubstr(fmt::format("complete until {:.3f} s",
                                             1e-9 * static_cast<double>(messages.back().time_ns))));
  EXPECT_THAT(what, ::testing::HasSubstr(path.string()));
}

TEST(McapFile, AKilledWriterLeavesWholeChunks) {
  const throng::testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  McapFile file(path, {.chunk_ns = 1000});
  const std::uint16_t a = file.add_channel("/a", kText);
  for (std::uint64_t i = 0; i < 25; ++i) file.add(a, 100 * i, "message");
  // A kill would leave the file as it is now.
  std::size_t messages = 0;
  for (const Record& record : read_records(read_file(path).substr(kMagicBytes))) {
    if (record.opcode == 6) messages += read_chunk(record.content).size();
    EXPECT_NE(record.opcode, 15) << "the end of the data";
  }
  EXPECT_EQ(messages, 22U) << "two chunks of which each spans 1000 ns";
}

TEST(McapFile, KnowsUntilWhenItIsComplete) {
  const throng::testing::TemporaryFolder folder;
  McapFile file(folder.path() / "a.mcap", {.chunk_ns = 1000});
  const std::uint16_t a = file.add_channel("/a", kText);
  EXPECT_EQ(file.complete_until_ns(), 0U);
  for (const std::uint64_t time_ns : {100, 1500}) file.add(a, time_ns, "message");
  EXPECT_EQ(file.complete_until_ns(), 1500U);
  file.add(a, 1200, "late, and not in the file yet");
  EXPECT_EQ(file.complete_until_ns(), 1200U);
  file.close();
  EXPECT_EQ(file.complete_until_ns(), 1500U);
}

TEST(McapFile, FolderThatDoesNotExistIsNamed) {
  try {
    McapFile file("/nowhere/a.mcap");
    FAIL() << "no error";
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("/nowhere/a.mcap"));
  }
}

TEST(RosMessages, NumbersAreAlignedToTheirSize) {
  // Header of CDR, seconds, nanoseconds, length 6, "abcde" and 0, 2 bytes to the next multiple of 4
  // from the header's end, height and width.
  const std::string image = ros::image({"abcde", 1.5}, {3, 2, "mono8", 1, "123456"});
  Bytes bytes(image);
  EXPECT_EQ(bytes.take_bytes(4), std::string("\0\1\0\0", 4));
  EXPECT_EQ(bytes.take<std::int32_t>(), 1);
  EXPECT_EQ(bytes.take<std::uint32_t>(), 500'000'000U);
  EXPECT_EQ(bytes.take_text(), std::string("abcde\0", 6));
  bytes.take_bytes(2);
  EXPECT_EQ(bytes.take<std::uint32_t>(), 2U);
  EXPECT_EQ(bytes.take<std::uint32_t>(), 3U);
  EXPECT_EQ(bytes.take_text(), std::string("mono8\0", 6));
}

TEST(RosMessages, SchemasHoldEveryPart) {
  const McapSchema schema = ros::make_schema(ros::Kind::odometry);
  EXPECT_EQ(schema.name, "nav_msgs/msg/Odometry");
  for (const char* part : {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/Pose",
                           "geometry_msgs/Quaternion", "geometry_msgs/TwistWithCovariance"}) {
    EXPECT_THAT(schema.text, ::testing::HasSubstr(std::string("MSG: ") + part + "\n"));
  }
}

}  // namespace
}  // namespace throng::formats::mcap
