#include "base/text/slug.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

TEST(Slug, IsASafeName) {
  EXPECT_EQ(slug("City square, guided evacuation"), "city-square-guided-evacuation");
  EXPECT_EQ(slug("../../etc"), "etc");
  EXPECT_EQ(slug("\xc3\xa9"), "dataset");
  EXPECT_LE(slug(std::string(500, 'x')).size(), 60U);
}

}  // namespace
}  // namespace throng
