#include "base/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "base/random.h"

namespace throng {
namespace {

/// As zlib reads it.
std::vector<std::uint8_t> inflated(std::string_view stream, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  auto got = static_cast<uLongf>(size);
  const int status = ::uncompress(bytes.data(), &got, reinterpret_cast<const Bytef*>(stream.data()),
                                  static_cast<uLong>(stream.size()));
  EXPECT_EQ(status, Z_OK);
  bytes.resize(got);
  return bytes;
}

TEST(Deflate, ZlibReadsIt) {
  std::vector<std::uint8_t> room;
  for (const std::size_t size : {0U, 1U, 100U, 70'000U, 3'000'000U}) {
    for (const bool noise : {false, true}) {
      std::vector<std::uint8_t> bytes(size);
      Random random(1, Stream::crowd_generator, size);
      for (std::size_t i = 0; i < size; ++i) {
        bytes[i] = static_cast<std::uint8_t>(noise ? random.uniform(0, 256)
                                                   : static_cast<double>(i / 1000 % 256));
      }
      const std::string_view stream = deflated(bytes, room);
      EXPECT_EQ(inflated(stream, size + 1), bytes) << size;
      EXPECT_TRUE(noise || size < 1000 || stream.size() < size / 20) << size;
    }
  }
}

}  // namespace
}  // namespace throng
