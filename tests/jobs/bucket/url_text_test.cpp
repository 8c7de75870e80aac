#include "jobs/bucket/url_text.h"

#include <gtest/gtest.h>

namespace throng::bucket {
namespace {

TEST(UrlText, KeysKeepTheirSlashes) {
  EXPECT_EQ(encoded_path("a/day=1/b c+d~.jpg"), "a/day%3D1/b%20c%2Bd~.jpg");
  EXPECT_EQ(encoded_path("\xC3\xA9"), "%C3%A9");
}

TEST(UrlText, QueriesAreSortedAndNamesWithoutValueHaveTheirSign) {
  EXPECT_EQ(query_text({}), "");
  EXPECT_EQ(query_text({{"uploads", ""}, {"prefix", "a/b="}}), "?prefix=a%2Fb%3D&uploads=");
  EXPECT_EQ(query_text({{"list-type", "2"}, {"continuation-token", "1/+="}, {"prefix", ""}}),
            "?continuation-token=1%2F%2B%3D&list-type=2&prefix=");
}

}  // namespace
}  // namespace throng::bucket
