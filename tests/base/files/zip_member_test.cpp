// ZIP files of one member, against bytes, damages and the sizes that other tools have.
#include "base/files/zip_member.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace throng {
namespace {

std::string noise(std::size_t count) {
  std::string bytes;
  std::uint32_t state = 7;
  for (std::size_t i = 0; i < count; ++i) {
    state = state * 1664525U + 1013904223U;
    bytes.push_back(static_cast<char>(state >> 24U));
  }
  return bytes;
}

TEST(ZipMember, ComesBackWhole) {
  for (const std::string& bytes :
       {std::string(), std::string("a"), std::string(3'000'000, '\0'), noise(700'000)}) {
    const std::string zip = make_zip("density.npy", bytes);
    EXPECT_EQ(zip_member(zip, "density.npy", bytes.size()), bytes);
    EXPECT_EQ(zip, make_zip("density.npy", bytes));
    EXPECT_EQ(zip.substr(0, 2), "PK");
  }
}

TEST(ZipMember, TakesLittleRoomForZeros) {
  EXPECT_LT(make_zip("a", std::string(4'000'000, '\0')).size(), 40'000U);
}

TEST(ZipMember, IsRefusedIfItIsMissingOrTooLarge) {
  const std::string zip = make_zip("a.npy", std::string(1000, 'x'));
  EXPECT_THROW(zip_member(zip, "b.npy", 2000), InputError);
  EXPECT_THROW(zip_member(zip, "a.npy", 999), InputError);
  EXPECT_THROW(zip_member("no zip", "a.npy", 2000), InputError);
  EXPECT_THROW(zip_member("", "a.npy", 2000), InputError);
}

TEST(ZipMember, DamagedDataAreRefused) {
  const std::string bytes = noise(5000);
  const std::string zip = make_zip("a.npy", bytes);
  for (std::size_t at = 100; at < 5000; at += 7) {
    std::string damaged = zip;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    EXPECT_THROW(zip_member(damaged, "a.npy", 2 * bytes.size()), InputError) << at;
  }
}

TEST(ZipMember, DamagedHeadersGiveAnErrorOrNoMoreThanIsAllowed) {
  const std::string bytes = noise(5000);
  const std::string zip = make_zip("a.npy", bytes);
  const auto read = [&](const std::string& damaged) {
    try {
      EXPECT_LE(zip_member(damaged, "a.npy", 2 * bytes.size()).size(), 2 * bytes.size());
    } catch (const InputError&) {
    }
  };
  for (std::size_t at = 0; at < zip.size(); ++at) {
    if (at == 100) at = zip.size() - 150;
    std::string damaged = zip;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    read(damaged);
  }
  for (std::size_t size = 0; size < zip.size(); size += 97) read(zip.substr(0, size));
}

}  // namespace
}  // namespace throng
