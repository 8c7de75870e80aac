#include "base/files/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>
#include <vector>

#include "base/compute/random.h"

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

// Earlier contents of the stack must not show in the bytes.
[[gnu::noinline]] void fill_stack(std::uint16_t value) {
  volatile std::uint16_t words[100'000];  // more than the library's state takes
  for (volatile std::uint16_t& word : words) word = value;
}

[[gnu::noinline]] std::string compressed_after(std::uint16_t value,
                                               const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint8_t> room;
  fill_stack(value);
  return std::string(deflated(bytes, room));
}

TEST(Deflate, EqualInputGivesEqualBytesWhateverWasInMemory) {
  std::vector<std::uint8_t> bytes(461'040, 0);
  for (std::size_t i = 0; i < bytes.size(); i += 1921) bytes[i] = 2;
  const std::string whole = compressed_after(0, bytes);
  // As the library's hist_bits: windows of 2^value bytes.
  for (const std::uint16_t value : {1, 5, 9, 12}) {
    EXPECT_TRUE(compressed_after(value, bytes) == whole) << value;
  }
}

}  // namespace
}  // namespace throng
