#include "jobs/bucket/listing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace throng::bucket {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

// The examples of the API's reference, shortened.
TEST(Listing, ObjectsAndTheNextPage) {
  const auto page = read_objects(R"(<?xml version="1.0" encoding="UTF-8"?>
<ListBucketResult xmlns="http://s3.amazonaws.com/doc/2006-03-01/"><Name>bucket</Name><Prefix/>
<NextContinuationToken>1ueGcxLPRx1Tr/XYExHnhbYLgveDs2J/wm36Hy4vbOwM=</NextContinuationToken>
<KeyCount>1</KeyCount><MaxKeys>1</MaxKeys><IsTruncated>true</IsTruncated>
<Contents><Key>a &amp; b.jpg</Key><LastModified>2014-11-21T19:40:05.000Z</LastModified>
<ETag>&quot;70ee1738b6b21e2c8a43f3a5ab0eee71&quot;</ETag><Size>9223372036854775807</Size></Contents>
</ListBucketResult>)");
  ASSERT_EQ(page.entries.size(), 1U);
  EXPECT_EQ(page.entries[0].key, "a & b.jpg");
  EXPECT_EQ(page.entries[0].tag, "70ee1738b6b21e2c8a43f3a5ab0eee71");
  EXPECT_EQ(page.entries[0].bytes, 9223372036854775807);
  EXPECT_THAT(page.next, ElementsAre(Pair("continuation-token",
                                          "1ueGcxLPRx1Tr/XYExHnhbYLgveDs2J/wm36Hy4vbOwM=")));
}

TEST(Listing, UploadsAndParts) {
  const auto uploads = read_uploads(R"(<ListMultipartUploadsResult>
<NextKeyMarker>b</NextKeyMarker><NextUploadIdMarker>2</NextUploadIdMarker>
<IsTruncated>true</IsTruncated><Upload><Key>a</Key><UploadId>1</UploadId></Upload>
<Upload><Key>b</Key><UploadId>2</UploadId></Upload></ListMultipartUploadsResult>)");
  ASSERT_EQ(uploads.entries.size(), 2U);
  EXPECT_EQ(uploads.entries[1].id, "2");
  EXPECT_THAT(uploads.next, ElementsAre(Pair("key-marker", "b"), Pair("upload-id-marker", "2")));
  const auto parts = read_parts(R"(<ListPartsResult><IsTruncated>false</IsTruncated>
<NextPartNumberMarker>3</NextPartNumberMarker><Part><PartNumber>2</PartNumber>
<ETag>"7778aef83f66abc1fa1e8477f296d394"</ETag><Size>10485760</Size></Part></ListPartsResult>)");
  ASSERT_EQ(parts.entries.size(), 1U);
  EXPECT_EQ(parts.entries[0].number, 2);
  EXPECT_EQ(parts.entries[0].tag, "7778aef83f66abc1fa1e8477f296d394");
  EXPECT_EQ(parts.entries[0].bytes, 10485760);
  EXPECT_TRUE(parts.next.empty());
}

TEST(Listing, AnswersThatAreNoListingsAreRefused) {
  for (const char* wrong :
       {"", "<ListBucketResult>", "<html></html>", "{}", "<Error><Code>SlowDown</Code></Error>",
        "<ListBucketResult><IsTruncated>true</IsTruncated></ListBucketResult>"}) {
    EXPECT_THROW(read_objects(wrong), EnvironmentError) << wrong;
  }
}

TEST(Listing, OneThatDoesNotEndIsRefused) {
  Page<ListedObject> page;
  page.entries.assign(1000, ListedObject{std::string(1000, 'k'), 1, std::string(32, 't')});
  ListingBound large;
  int pages = 0;
  const auto add_all = [&] {
    for (; pages < 1000; ++pages) {
      page.next = {{"continuation-token", std::to_string(pages)}};
      large.add(page);
    }
  };
  EXPECT_THROW(add_all(), EnvironmentError);
  EXPECT_GT(pages, 200);

  Page<ListedUpload> again;
  again.next = {{"key-marker", "a"}, {"upload-id-marker", "b"}};
  ListingBound circle;
  circle.add(again);
  EXPECT_THROW(circle.add(again), EnvironmentError);

  ListingBound empty;
  Page<ListedPart> nothing;
  const auto add_nothing = [&] {
    for (int i = 0; i <= 100'000; ++i) {
      nothing.next = {{"part-number-marker", std::to_string(i)}};
      empty.add(nothing);
    }
  };
  EXPECT_THROW(add_nothing(), EnvironmentError);
}

TEST(Listing, AnErrorIsItsCodeAndItsMessage) {
  const StoreError error = read_error(
      "<?xml version=\"1.0\"?>\n<Error><Code>SignatureDoesNotMatch</Code>"
      "<Message>It does not match.\nAKID secret</Message><AWSAccessKeyId>AKID</AWSAccessKeyId>"
      "<StringToSign>AWS4</StringToSign></Error>");
  EXPECT_EQ(error_text(error, 403), "SignatureDoesNotMatch: It does not match.");
  EXPECT_EQ(error_text(read_error("<html>"), 502), "the object store answered with status 502");
  EXPECT_LE(first_line(std::string(100'000, 'x')).size(), 300U);
  EXPECT_EQ(first_line("a\x1b[31mb"), "a?[31mb");
  EXPECT_EQ(read_value("<InitiateMultipartUploadResult><UploadId>x</UploadId>"
                       "</InitiateMultipartUploadResult>",
                       "UploadId"),
            "x");
}

}  // namespace
}  // namespace throng::bucket
