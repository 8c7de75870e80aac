// A recording of 5 GB, most of which the file system does not have to keep.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "formats/files/mcap_file.h"
#include "tests/formats/files/mcap_reader.h"
#include "tests/world/temporary_folder.h"

namespace throng::formats::mcap {
namespace {

/// Gives the space of a file's middle back, whose bytes are zeros.
void punch_holes(const std::filesystem::path& path, std::uint64_t from, std::uint64_t to) {
  const int file = ::open(path.c_str(), O_WRONLY);
  ASSERT_GE(file, 0);
  ::fallocate(file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(from),
              static_cast<off_t>(to - from));
  ::close(file);
}

TEST(McapFile, FiveGigabytesNeedNoMoreMemoryThanAChunk) {
  const throng::testing::TemporaryFolder folder;
  const auto path = folder.path() / "large.mcap";
  McapFile file(path, {.is_compressed = false});
  const std::uint16_t a = file.add_channel("/a", kText);
  const std::string zeros(std::size_t{1} << 22, '\0');
  constexpr std::uint64_t kMessages = 1200;
  rusage before{};
  rusage after{};
  std::uint64_t punched = 1 << 16;
  for (std::uint64_t i = 0; i < kMessages; ++i) {
    file.add(a, i, zeros);
    if (i == 20) getrusage(RUSAGE_SELF, &before);
    if (i % 50 != 49) continue;
    const std::uint64_t to = (i - 1) * zeros.size();
    punch_holes(path, punched, to);
    punched = to;
  }
  file.add(a, kMessages, "the end");
  file.close();
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 8 * 1024) << "KiB";
  const std::uint64_t size = std::filesystem::file_size(path);
  EXPECT_GT(size, std::uint64_t{5} * 1000 * 1000 * 1000);

  std::ifstream stream(path, std::ios::binary);
  const auto read = [&](std::uint64_t at, std::uint64_t bytes) {
    std::string text(bytes, '\0');
    stream.seekg(static_cast<std::streamoff>(at));
    stream.read(text.data(), static_cast<std::streamsize>(bytes));
    return text;
  };
  Bytes footer(read(size - 28, 20));
  const auto summary_at = footer.take<std::uint64_t>();
  std::uint64_t last_chunk_at = 0;
  std::uint64_t last_chunk_size = 0;
  for (const Record& record : read_records(read(summary_at, size - kMagicBytes - summary_at))) {
    if (record.opcode != 8) continue;
    Bytes index(record.content);
    index.take<std::uint64_t>();
    index.take<std::uint64_t>();
    last_chunk_at = index.take<std::uint64_t>();
    last_chunk_size = index.take<std::uint64_t>();
  }
  EXPECT_GT(last_chunk_at, std::uint64_t{1} << 32);
  const std::vector<Message> last = read_chunk(read(last_chunk_at + 9, last_chunk_size - 9));
  EXPECT_EQ(last.back().data, "the end");
  EXPECT_EQ(last.back().sequence, kMessages);
}

}  // namespace
}  // namespace throng::formats::mcap
