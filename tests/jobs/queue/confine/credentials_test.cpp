#include "jobs/queue/confine/credentials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "base/files/files.h"
#include "jobs/queue/confine/child_process.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kSecret = "wJalrXUtnFEMI";

std::string environment_in_proc() {
  std::ifstream file("/proc/self/environ", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(Credentials, TheEnvironmentLeavesProcAndStaysInMemory) {
  EXPECT_EXIT(
      {
        const bool was_there = environment_in_proc().find("PATH=") != std::string::npos;
        const std::string path = std::getenv("PATH");
        hide_environment();
        hide_environment();  // once more does no harm
        const bool is_gone = environment_in_proc().find("PATH=") == std::string::npos;
        ::setenv("THRONG_TEST", "new", 1);
        ::_exit(was_there && is_gone && path == std::getenv("PATH") ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Credentials, ChildrenGetSecretsOnStandardInputOnly) {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  ChildProcess child({"/bin/sh", "-c",
                      "tr '\\0' '\\n' < /proc/self/environ > " + out.string() + "; echo STDIN >> " +
                          out.string() + "; tr '\\0' '\\n' >> " + out.string()},
                     {{"AWS_SECRET_ACCESS_KEY", kSecret}, {"THRONG_OTHER", "plain"}},
                     folder.path() / "log");
  EXPECT_EQ(child.wait().code, 0);
  const std::string text = read_file(out);
  const std::string environment = text.substr(0, text.find("STDIN"));
  EXPECT_THAT(environment, Not(HasSubstr(kSecret)));
  EXPECT_THAT(environment, HasSubstr("THRONG_OTHER=plain"));
  EXPECT_THAT(text.substr(environment.size()),
              HasSubstr("AWS_SECRET_ACCESS_KEY=" + std::string(kSecret) + "\n"));
}

TEST(Credentials, AChildTakesCredentialsOnly) {
  EXPECT_EXIT(
      {
        const int memory = descriptor_of_credentials(
            {{"AWS_ACCESS_KEY_ID", "AKIA"}, {"AWS_SECRET_ACCESS_KEY", "a=b\nc"}, {"PATH", "evil"}});
        ::dup2(memory, STDIN_FILENO);
        const std::string path = std::getenv("PATH");
        take_credentials();
        const std::string secret = std::getenv("AWS_SECRET_ACCESS_KEY");
        ::_exit(secret == "a=b\nc" && path == std::getenv("PATH") ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Credentials, NamesThatTellOfASecretAreNotHandedOn) {
  for (const char* name : {"AWS_REGION", "GITHUB_TOKEN", "DB_PASSWORD", "CLIENT_SECRET"}) {
    EXPECT_TRUE(is_secret_variable(name)) << name;
  }
  for (const char* name : {"PATH", "HOME", "THRONG_PRIVATE_CREDENTIALS", "LP_NUM_THREADS"}) {
    EXPECT_FALSE(is_secret_variable(name)) << name;
  }
}

}  // namespace
}  // namespace throng::jobs
