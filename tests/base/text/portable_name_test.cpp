#include "base/text/portable_name.h"

#include <gtest/gtest.h>

#include "base/text/slug.h"

namespace throng {
namespace {

TEST(PortableName, DevicesOfWindowsAreKnownWithAnySuffix) {
  for (const char* name : {"con", "CON", "Aux", "nul.txt", "prn.opencv.yaml", "com1", "LPT9.x",
                           "con .txt", "CONOUT$"}) {
    EXPECT_TRUE(is_device_name(name)) << name;
  }
  for (const char* name : {"", "cons", "icon", "com", "com10", "lpt", "comx", "a.con", "nul-1"}) {
    EXPECT_FALSE(is_device_name(name)) << name;
  }
}

TEST(PortableName, PathsAreThoseOfAllSystems) {
  for (const char* path : {"images/run000/d1/000000.jpg", "a", "a b/c-_.d", "./a//b", ".hidden"}) {
    EXPECT_EQ(path_fault(path), std::nullopt) << path;
  }
  for (const char* path : {"/a",   "../a",  "a/../b",    "a.",        "a./b",
                           "a ",   " a/b",  "a:b",       "a\\b",      "a?",
                           "a*",   "a<b",   "a>b",       "a|b",       "a\"b",
                           "a\nb", "a\x7f", "r\xc3\xa9", "run/aux/1", "cameras/nul.yaml"}) {
    EXPECT_NE(path_fault(path), std::nullopt) << path;
  }
  EXPECT_EQ(path_fault(std::string(255, 'a') + "/b"), std::nullopt);
  EXPECT_NE(path_fault(std::string(256, 'a') + "/b"), std::nullopt);
}

TEST(PortableName, PathsDifferInMoreThanCase) {
  DistinctPaths paths;
  for (const char* path : {"run/a/1.jpg", "run/a/2.jpg", "run/b/1.jpg", "run/a/3.jpg", "top"}) {
    EXPECT_FALSE(paths.add(path)) << path;
  }
  EXPECT_FALSE(paths.add("run", true));
  EXPECT_EQ(paths.folders(), 3U);
  const auto clash_of = [&](const char* path) {
    const auto clash = paths.add(path);
    return clash ? clash->earlier + (clash->is_equal ? " again" : "") : "";
  };
  EXPECT_EQ(clash_of("run/a/1.JPG"), "run/a/1.jpg");
  EXPECT_EQ(clash_of("run/A/9.jpg"), "run/a") << "one folder on Windows";
  EXPECT_EQ(clash_of("Run/c/1.jpg"), "run");
  EXPECT_EQ(clash_of("run/a/1.jpg"), "run/a/1.jpg again");
  EXPECT_EQ(clash_of("top/a"), "top again") << "a file is no folder";
  EXPECT_EQ(clash_of("run/b"), "run/b again");
}

TEST(PortableName, NoSlugIsADevice) {
  EXPECT_EQ(slug("CON"), "con-dataset");
  EXPECT_EQ(slug(" (lpt1) "), "lpt1-dataset");
  EXPECT_EQ(slug("console"), "console");
}

}  // namespace
}  // namespace throng
