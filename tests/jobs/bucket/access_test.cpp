#include "jobs/bucket/access.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "base/files/files.h"
#include "tests/jobs/yard.h"

namespace throng::bucket {
namespace {

using testing::HasSubstr;
using testing::Not;

class AccessTest : public testing::Test {
 protected:
  AccessTest() {
    for (const char* name :
         {"AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY", "AWS_SESSION_TOKEN", "AWS_REGION",
          "AWS_DEFAULT_REGION", "AWS_ENDPOINT_URL", "AWS_ENDPOINT_URL_S3", "AWS_PROFILE",
          "AWS_SHARED_CREDENTIALS_FILE", "AWS_CONFIG_FILE"}) {
      ::unsetenv(name);
    }
    set("HOME", home.path().string());
  }

  static void set(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 1); }

  void write(const std::string& name, const std::string& text) const {
    write_file_atomically(home.path() / ".aws" / name, text);
  }

  static std::string refusal() {
    try {
      read_access();
      return "";
    } catch (const std::exception& error) {
      return error.what();
    }
  }

  jobs::TemporaryFolder home;
};

TEST_F(AccessTest, TheEnvironmentComesFirst) {
  write("credentials",
        "[default]\naws_access_key_id=file\naws_secret_access_key=file\n"
        "aws_session_token=file\n");
  write("config", "[default]\nregion = eu-north-1\n");
  EXPECT_EQ(read_access().key_id, "file");
  EXPECT_EQ(read_access().token, "file");
  EXPECT_EQ(read_access().region, "eu-north-1");
  set("AWS_ACCESS_KEY_ID", "id");
  set("AWS_SECRET_ACCESS_KEY", "secret");
  set("AWS_DEFAULT_REGION", "us-west-1");
  const Access access = read_access();
  EXPECT_EQ(access.key_id, "id");
  EXPECT_EQ(access.secret, "secret");
  EXPECT_EQ(access.token, "") << "it belongs to other keys";
  EXPECT_EQ(access.region, "us-west-1");
}

TEST_F(AccessTest, ProfilesOfBothFiles) {
  write("credentials",
        "# mine\n[other]\naws_access_key_id = other\n[mine]\n"
        "aws_access_key_id = id\naws_secret_access_key = a=b\n");
  write("config",
        "[mine]\nregion = wrong\n[profile mine]\nregion=eu-west-1\n"
        "endpoint_url = https://objects.example.org/\n");
  set("AWS_PROFILE", "mine");
  const Access access = read_access();
  EXPECT_EQ(access.key_id, "id");
  EXPECT_EQ(access.secret, "a=b");
  EXPECT_EQ(access.region, "eu-west-1");
  EXPECT_EQ(access.endpoint, "https://objects.example.org");
}

TEST_F(AccessTest, MissingValuesAreNamed) {
  EXPECT_THAT(refusal(), HasSubstr("AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY"));
  set("AWS_ACCESS_KEY_ID", "id");
  EXPECT_THAT(refusal(), HasSubstr("AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY"));
  set("AWS_SECRET_ACCESS_KEY", "secret");
  EXPECT_THAT(refusal(), HasSubstr("AWS_REGION"));
  set("AWS_ENDPOINT_URL", "http://127.0.0.1:9000");
  EXPECT_EQ(read_access().region, "us-east-1");
}

TEST_F(AccessTest, EndpointsThatAreNoneAreRefusedWithoutTheirPassword) {
  set("AWS_ACCESS_KEY_ID", "id");
  set("AWS_SECRET_ACCESS_KEY", "secret");
  for (const char* wrong : {"objects.example.org", "ftp://x", "https://", "https://me:hunter2@x",
                            "https://x/?hunter2", "https://x/#hunter2"}) {
    set("AWS_ENDPOINT_URL_S3", wrong);
    EXPECT_THROW(read_access(), InputError) << wrong;
    EXPECT_THAT(refusal(), Not(HasSubstr("hunter2")));
  }
  set("AWS_ENDPOINT_URL_S3", "https://x");
  set("AWS_SECRET_ACCESS_KEY", "two\nlines");
  EXPECT_THAT(refusal(), HasSubstr("AWS_SECRET_ACCESS_KEY"));
  EXPECT_THAT(refusal(), Not(HasSubstr("two")));
}

TEST(BucketUrl, ByHostAtAmazonAndByPathElsewhere) {
  const Access amazon{.region = "eu-west-1"};
  EXPECT_EQ(url_of_bucket(amazon, {"data", ""}), "https://data.s3.eu-west-1.amazonaws.com");
  EXPECT_EQ(url_of_bucket(amazon, {"my.data", ""}), "https://s3.eu-west-1.amazonaws.com/my.data");
  EXPECT_EQ(url_of_bucket({.region = "cn-north-1"}, {"data", ""}),
            "https://data.s3.cn-north-1.amazonaws.com.cn");
  EXPECT_EQ(url_of_bucket({.endpoint = "http://127.0.0.1:9000"}, {"data", "x"}),
            "http://127.0.0.1:9000/data");
}

}  // namespace
}  // namespace throng::bucket
