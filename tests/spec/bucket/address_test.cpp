#include "spec/bucket/address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace throng::bucket {
namespace {

using testing::HasSubstr;
using testing::Not;

Address parse_publish_address(std::string_view text) {
  return parse_address(text, "", "/outputs/publish");
}

TEST(BucketAddress, BucketPrefixAndKeys) {
  const Address address = parse_publish_address("s3://my-data.2/crowds/day=1/a_b.c/");
  EXPECT_EQ(address.bucket, "my-data.2");
  EXPECT_EQ(address.prefix, "crowds/day=1/a_b.c");
  EXPECT_EQ(address.text(), "s3://my-data.2/crowds/day=1/a_b.c");
  EXPECT_EQ(address.key_of("images/1.jpg"), "crowds/day=1/a_b.c/images/1.jpg");
  EXPECT_EQ(parse_publish_address("s3://data").key_of("manifest.json"), "manifest.json");
  EXPECT_EQ(parse_publish_address("s3://data/").text(), "s3://data");
}

TEST(BucketAddress, AddressesThatCannotBeSignedOrLackABucketAreRefused) {
  for (const char* wrong : {"",
                            "s3",
                            "s3:/data",
                            "https://data/x",
                            "s3://",
                            "s3:///x",
                            "s3://ab/x",
                            "s3://Data/x",
                            "s3://-ab/x",
                            "s3://ab-/x",
                            "s3://a..b/x",
                            "s3://192.168.0.1/x",
                            "s3://a_b/x",
                            "s3://data//x",
                            "s3://data/x//",
                            "s3://data/./x",
                            "s3://data/../x",
                            "s3://data/x y",
                            "s3://data/x?y",
                            "s3://data/x%2Fy",
                            "s3://data/\n",
                            "s3://data/\xC3\xA9"}) {
    EXPECT_THROW(parse_publish_address(wrong), InputError) << wrong;
  }
  EXPECT_THROW(parse_publish_address("s3://" + std::string(64, 'a')), InputError);
  EXPECT_THROW(parse_publish_address("s3://data/" + std::string(513, 'a')), InputError);
  EXPECT_NO_THROW(parse_publish_address("s3://data/" + std::string(512, 'a')));
}

TEST(BucketAddress, APasswordIsNotRepeated) {
  try {
    parse_publish_address("s3://me:hunter2@data/x");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/outputs/publish: found an address with a user"));
    EXPECT_THAT(error.what(), Not(HasSubstr("hunter2")));
  }
}

TEST(BucketAddress, WithinAnotherByWholeSegments) {
  const auto is_within = [](const char* a, const char* b) {
    return parse_publish_address(a).is_within(parse_publish_address(b));
  };
  EXPECT_TRUE(is_within("s3://data/a", "s3://data/a"));
  EXPECT_TRUE(is_within("s3://data/a/b", "s3://data/a"));
  EXPECT_TRUE(is_within("s3://data/a", "s3://data"));
  EXPECT_FALSE(is_within("s3://data/ab", "s3://data/a"));
  EXPECT_FALSE(is_within("s3://data", "s3://data/a"));
  EXPECT_FALSE(is_within("s3://data2/a", "s3://data"));
}

}  // namespace
}  // namespace throng::bucket
