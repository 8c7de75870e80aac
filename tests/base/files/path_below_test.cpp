#include "base/files/path_below.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace throng {
namespace {

TEST(PathBelow, NamesFilesOfItsFolderOnly) {
  for (const char* path : {"a", "images/run000/d1/000001.jpg", "a..b/...", "-", "ä/é"}) {
    EXPECT_TRUE(is_path_below(path)) << path;
  }
  for (const char* path : {"", "/", "/etc/passwd", "..", "../x", "a/../../x", "a/..", "./a", "a//b",
                           "a/", "a\\..\\b", "a\nb", "a/\x7F"}) {
    EXPECT_FALSE(is_path_below(path)) << path;
  }
  EXPECT_FALSE(is_path_below(std::string_view("a\0b", 3)));
  EXPECT_TRUE(is_path_part("run000"));
  EXPECT_FALSE(is_path_part("a/b"));
}

TEST(PathBelow, OthersAreRefusedWhereTheyStand) {
  try {
    require_path_below("../x\xFF", "manifest.json", "/files/3/path");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(
                                  "manifest.json: /files/3/path: found \"../x\uFFFD\", expected"));
  }
}

}  // namespace
}  // namespace throng
