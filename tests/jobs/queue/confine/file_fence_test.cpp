#include "jobs/queue/confine/file_fence.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "base/files/files.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

namespace fs = std::filesystem;

/// A data folder with what lies in one, and a folder beside it.
class FileFenceTest : public testing::Test {
 protected:
  FileFenceTest() {
    version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    has_landlock = version >= 2;
    write_file_atomically(data / "keys.sqlite", "secret");
    write_file_atomically(database / "jobs.sqlite", "secret");
    write_file_atomically(data / "jobs/mine/job.json", "{}");
    write_file_atomically(data / "jobs/other/job.json", "theirs");
    write_file_atomically(data / "uploads/plaza/files/plaza.json", "plaza");
    fs::create_directories(data / "scenarios");
    fs::create_directory_symlink("../uploads/plaza/files", data / "scenarios/plaza");
    write_file_atomically(outside / "file", "outside");
    fs::create_symlink(outside / "file", mine / "to_outside");
    fs::create_symlink(data / "keys.sqlite", mine / "to_keys");
  }

  /// Whether an attempt succeeds in a process that is fenced.
  bool succeeds(const std::function<bool()>& attempt, bool hides = true) const {
    const pid_t child = ::fork();
    if (child == 0) {
      FileFence fence{{mine}, {}, {data / "scenarios", data / "uploads"}};
      if (hides) fence.hidden = {data, database};
      if (!fence_this_process(fence).empty()) ::_exit(2);
      ::_exit(attempt() ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) < 2);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  static bool can_open(const fs::path& file, int flags) {
    const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, 0644);
    if (descriptor >= 0) ::close(descriptor);
    return descriptor >= 0;
  }

  TemporaryFolder base;
  TemporaryFolder elsewhere;
  TemporaryFolder local;
  fs::path database = local.path() / "database";
  fs::path data = base.path() / "data";
  fs::path mine = data / "jobs/mine";
  fs::path outside = elsewhere.path();
  long version = 0;
  bool has_landlock = false;
};

#define SKIP_WITHOUT_LANDLOCK() \
  if (!has_landlock) GTEST_SKIP() << "the kernel has no Landlock that allows renames"

TEST_F(FileFenceTest, ItsOwnFolderIsFree) {
  SKIP_WITHOUT_LANDLOCK();
  EXPECT_TRUE(succeeds([&] { return can_open(mine / "new", O_WRONLY | O_CREAT | O_EXCL); }));
  EXPECT_TRUE(succeeds([&] {
    write_file_atomically(mine / "work/run000/trace.h5", "x");
    fs::rename(mine / "work/run000/trace.h5", mine / "moved");
    fs::create_hard_link(mine / "moved", mine / "work/second");
    return fs::remove(mine / "moved") && fs::remove_all(mine / "work") > 0;
  }));
  EXPECT_TRUE(succeeds([&] { return ::truncate((mine / "job.json").c_str(), 1) == 0; }));
}

TEST_F(FileFenceTest, CredentialsAreReadByTheOneThatPublishes) {
  SKIP_WITHOUT_LANDLOCK();
  const fs::path in_home = outside / ".aws/credentials";
  const fs::path named = outside / "keys";
  const fs::path beside = outside / "file";
  write_file_atomically(in_home, "secret");
  write_file_atomically(named, "secret");
  const auto reads = [&](const fs::path& file, Credentials credentials) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::setenv("HOME", outside.c_str(), 1);
      ::setenv(kPrivateCredentialsVariable, named.c_str(), 1);
      if (!fence_this_process(fence_of_folder(mine, credentials)).empty()) ::_exit(2);
      ::_exit(can_open(file, O_RDONLY) ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) < 2);
    return WEXITSTATUS(status) == 0;
  };
  for (const fs::path& file : {in_home, named}) {
    EXPECT_TRUE(reads(file, Credentials::readable)) << file;
    EXPECT_FALSE(reads(file, Credentials::hidden)) << file;
  }
  EXPECT_TRUE(reads(beside, Credentials::hidden));
}

TEST_F(FileFenceTest, ItMakesNoLinksOrPipesThatTheServiceWouldOpen) {
  SKIP_WITHOUT_LANDLOCK();
  const fs::path socket = mine / "socket";
  EXPECT_FALSE(succeeds([&] { return ::symlink("/etc/passwd", (mine / "link").c_str()) == 0; }));
  EXPECT_FALSE(succeeds([&] { return ::mkfifo((mine / "pipe").c_str(), 0644) == 0; }));
  EXPECT_FALSE(succeeds([&] { return ::mknod(socket.c_str(), S_IFSOCK | 0644, 0) == 0; }));
  EXPECT_FALSE(succeeds([&] {
    return ::rename((mine / "to_keys").c_str(), (mine / "work").c_str()) == 0 &&
           can_open(mine / "work", O_RDONLY);
  }));
}

TEST_F(FileFenceTest, NothingElseIsWritten) {
  SKIP_WITHOUT_LANDLOCK();
  const std::map<std::string, std::function<bool()>> attempts = {
      {"write", [&] { return can_open(outside / "file", O_WRONLY); }},
      {"append", [&] { return can_open(outside / "file", O_WRONLY | O_APPEND); }},
      {"create", [&] { return can_open(outside / "new", O_WRONLY | O_CREAT); }},
      {"truncate by opening", [&] { return can_open(outside / "file", O_RDONLY | O_TRUNC); }},
      {"folder", [&] { return ::mkdir((outside / "folder").c_str(), 0755) == 0; }},
      {"remove", [&] { return ::unlink((outside / "file").c_str()) == 0; }},
      {"rename out",
       [&] { return ::rename((mine / "job.json").c_str(), (outside / "job.json").c_str()) == 0; }},
      {"rename in",
       [&] { return ::rename((outside / "file").c_str(), (mine / "taken").c_str()) == 0; }},
      {"link out",
       [&] { return ::link((mine / "job.json").c_str(), (outside / "linked").c_str()) == 0; }},
      {"link in",
       [&] { return ::link((outside / "file").c_str(), (mine / "linked").c_str()) == 0; }},
      {"symlink", [&] { return ::symlink("x", (outside / "symlink").c_str()) == 0; }},
      {"by a link of one's own", [&] { return can_open(mine / "to_outside", O_WRONLY); }},
      {"by /proc",
       [&] { return can_open(fs::path("/proc/self/root" + outside.string()) / "file", O_WRONLY); }},
      {"by ..", [&] { return can_open(mine / "../other/job.json", O_WRONLY); }},
      {"in the data folder", [&] { return can_open(data / "new", O_WRONLY | O_CREAT); }},
      {"uploads", [&] { return can_open(data / "uploads/plaza/files/plaza.json", O_WRONLY); }},
      {"fifo", [&] { return ::mkfifo((outside / "fifo").c_str(), 0644) == 0; }},
      {"by a grandchild",
       [&] {
         const pid_t child = ::fork();
         if (child == 0) ::_exit(can_open(outside / "file", O_WRONLY) ? 0 : 1);
         int status = 0;
         ::waitpid(child, &status, 0);
         return WEXITSTATUS(status) == 0;
       }},
      {"by a second fence",
       [&] {
         static_cast<void>(fence_this_process({{outside}, {}, {}}));
         return can_open(outside / "file", O_WRONLY);
       }},
  };
  for (const auto& [name, attempt] : attempts) {
    EXPECT_FALSE(succeeds(attempt)) << name;
    EXPECT_FALSE(succeeds(attempt, false)) << name << ", nothing hidden";
  }
  EXPECT_EQ(read_file(outside / "file"), "outside");
  EXPECT_EQ(std::distance(fs::directory_iterator(outside), {}), 1);
}

TEST_F(FileFenceTest, OfTheDataFolderOnlyScenariosAndItsOwnFolderAreRead) {
  SKIP_WITHOUT_LANDLOCK();
  for (const fs::path& file :
       {data / "keys.sqlite", data / "jobs/other/job.json", mine / "to_keys",
        mine / "../../keys.sqlite", fs::path("/proc/self/root" + data.string()) / "keys.sqlite",
        database / "jobs.sqlite"}) {
    EXPECT_FALSE(succeeds([&] { return can_open(file, O_RDONLY); })) << file;
    EXPECT_TRUE(succeeds([&] { return can_open(file, O_RDONLY); }, false)) << file;
  }
  EXPECT_FALSE(succeeds([&] { return can_open(data, O_RDONLY | O_DIRECTORY); }));
  for (const fs::path& file :
       {data / "scenarios/plaza/plaza.json", data / "uploads/plaza/files/plaza.json",
        mine / "job.json", outside / "file", fs::path("/proc/self/status"), fs::path("/etc/passwd"),
        fs::path("/usr/bin/env"), fs::path("/bin/sh")}) {
    EXPECT_TRUE(succeeds([&] { return can_open(file, O_RDONLY); })) << file;
  }
  EXPECT_TRUE(succeeds([&] { return can_open("/dev/null", O_RDWR); }));
}

TEST_F(FileFenceTest, OtherProcessesGetNoSignals) {
  constexpr int kFirstWithScopes = 6;
  if (version < kFirstWithScopes) GTEST_SKIP() << "the kernel's Landlock knows no signals";
  const pid_t outsider = ::fork();
  if (outsider == 0) {
    ::pause();
    ::_exit(0);
  }
  EXPECT_FALSE(succeeds([&] { return ::kill(outsider, 0) == 0; }));
  EXPECT_FALSE(succeeds([&] { return ::kill(outsider, SIGKILL) == 0; }));
  EXPECT_FALSE(succeeds([&] { return ::kill(::getppid(), 0) == 0; }));
  EXPECT_TRUE(succeeds([&] { return ::kill(::getpid(), 0) == 0; }));
  EXPECT_EQ(::waitpid(outsider, nullptr, WNOHANG), 0);
  ::kill(outsider, SIGKILL);
  ::waitpid(outsider, nullptr, 0);
}

TEST_F(FileFenceTest, ADataFolderThatIsALinkIsHiddenToo) {
  SKIP_WITHOUT_LANDLOCK();
  const fs::path link = outside / "link";
  fs::create_directory_symlink(data, link);
  const pid_t child = ::fork();
  if (child == 0) {
    const bool fenced = fence_this_process({{link / "jobs/mine"}, {link}, {}}).empty();
    const bool reads =
        can_open(data / "keys.sqlite", O_RDONLY) || can_open(link / "keys.sqlite", O_RDONLY);
    ::_exit(fenced && !reads && can_open(link / "jobs/mine/job.json", O_RDWR) ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace throng::jobs
