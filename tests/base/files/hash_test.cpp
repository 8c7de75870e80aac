#include "base/files/hash.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/world/temporary_folder.h"

namespace throng {
namespace {

// The examples of FIPS 180-4, as NIST publishes them.
constexpr const char* kOfNothing =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* kOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kOfAMillionAs =
    "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(Sha256, AgreesWithTheStandard) {
  EXPECT_EQ(sha256_hex(""), kOfNothing);
  EXPECT_EQ(sha256_hex("abc"), kOfAbc);
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_hex(std::string(1'000'000, 'a')), kOfAMillionAs);
}

TEST(Sha256, InBase64AsPagesNameTheirScripts) {
  // As `openssl dgst -sha256 -binary | base64` has it.
  EXPECT_EQ(sha256_base64(""), "47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
  EXPECT_EQ(sha256_base64("abc"), "ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(sha256_hex_of_file(folder.write("empty", "")), kOfNothing);
  EXPECT_EQ(sha256_hex_of_file(folder.write("abc", "abc")), kOfAbc);
  // Longer than one block of reading.
  const std::string bytes(3'000'001, 'x');
  EXPECT_EQ(sha256_hex_of_file(folder.write("long", bytes)), sha256_hex(bytes));
  EXPECT_THROW(sha256_hex_of_file(folder.path() / "nowhere"), EnvironmentError);
}

}  // namespace
}  // namespace throng
