#include "base/text/url.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

TEST(PercentEncoded, KeepsUnreservedCharactersOnly) {
  EXPECT_EQ(percent_encoded("a-Z_0.~"), "a-Z_0.~");
  EXPECT_EQ(percent_encoded("a b/c?d=%"), "a%20b%2Fc%3Fd%3D%25");
  EXPECT_EQ(percent_encoded("\xC3\xBC"), "%C3%BC");
  EXPECT_EQ(percent_encoded("a/b c", "/"), "a/b%20c");
}

}  // namespace
}  // namespace throng
