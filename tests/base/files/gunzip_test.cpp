#include "base/files/gunzip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "base/error.h"

namespace throng {
namespace {

/// As zlib writes it.
std::string gzipped(const std::string& text) {
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  EXPECT_EQ(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY),
            Z_OK);
  std::string bytes(deflateBound(&stream, text.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

TEST(Gunzip, GivesWhatZlibCompressed) {
  for (const std::size_t size : {0U, 1U, 1000U, 3'000'000U}) {
    std::string text;
    for (std::size_t i = 0; i < size; ++i) text += static_cast<char>('a' + i * i % 7);
    EXPECT_TRUE(is_gzip(gzipped(text)));
    EXPECT_EQ(gunzipped(gzipped(text), "a.gz"), text) << size;
  }
  const std::string zeros(20'000'000, '0');
  EXPECT_EQ(gunzipped(gzipped(zeros), "a.gz"), zeros) << "1000 times as long as the file";
}

TEST(Gunzip, JoinsMembers) {
  EXPECT_EQ(gunzipped(gzipped("one\n") + gzipped("") + gzipped("two\n"), "a.gz"), "one\ntwo\n");
}

TEST(Gunzip, RefusesDamagedFiles) {
  const std::string sound = gzipped("some text that is long enough to be damaged");
  std::string flipped = sound;
  flipped[sound.size() / 2] ^= 0x10;
  for (const std::string& damaged :
       {sound.substr(0, sound.size() / 2), sound.substr(0, 2), flipped, sound + "more"}) {
    try {
      gunzipped(damaged, "walk.txt.gz");
      ADD_FAILURE() << "accepted " << damaged.size() << " bytes";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("walk.txt.gz"));
      EXPECT_THAT(error.what(), ::testing::HasSubstr("damaged gzip file"));
    }
  }
  EXPECT_FALSE(is_gzip("plain text"));
  EXPECT_FALSE(is_gzip(""));
}

}  // namespace
}  // namespace throng
