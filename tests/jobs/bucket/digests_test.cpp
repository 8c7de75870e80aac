#include "jobs/bucket/digests.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "tests/jobs/yard.h"

namespace throng::bucket {
namespace {

// By sha256sum and md5sum.
constexpr const char* kSha256OfAbc =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kMd5OfAbc = "900150983cd24fb0d6963f7d28e17f72";

TEST(Digests, OfBytes) {
  const Digest digest = compute_digest("abc");
  EXPECT_EQ(digest.sha256_hex, kSha256OfAbc);
  EXPECT_EQ(encode_hex(digest.md5), kMd5OfAbc);
  EXPECT_EQ(encode_base64(digest.md5), "kAFQmDzST7DWlj99KOF/cg==");
}

TEST(Digests, OfAFileAndItsParts) {
  const jobs::TemporaryFolder folder;
  write_file_atomically(folder.path() / "file", "abcabcab");
  const FileDigest digest = digest_of_file(folder.path() / "file", 3);
  EXPECT_EQ(digest.whole.sha256_hex, compute_digest("abcabcab").sha256_hex);
  ASSERT_EQ(digest.parts.size(), 3U);
  EXPECT_EQ(encode_hex(digest.parts[1].md5), kMd5OfAbc);
  EXPECT_EQ(digest.parts[2].sha256_hex, compute_digest("ab").sha256_hex);
  // By Python's hashlib: the MD5 of the three MD5, one after the other.
  EXPECT_EQ(tag_of_parts(digest.parts), "1111f10614445dd5553a128d5dd7e830-3");
}

TEST(Digests, OneOfTheSizeOfAPartIsWhole) {
  const jobs::TemporaryFolder folder;
  for (const char* text : {"", "abc"}) {
    write_file_atomically(folder.path() / "file", text);
    const FileDigest digest = digest_of_file(folder.path() / "file", 3);
    ASSERT_EQ(digest.parts.size(), 1U);
    EXPECT_EQ(digest.parts[0].sha256_hex, compute_digest(text).sha256_hex);
    EXPECT_EQ(digest.whole.md5, compute_digest(text).md5);
  }
  EXPECT_THROW(digest_of_file(folder.path() / "none", 3), EnvironmentError);
}

}  // namespace
}  // namespace throng::bucket
