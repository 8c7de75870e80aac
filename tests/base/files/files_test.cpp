#include "base/files/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/resource_exhaustion.h"
#include "tests/world/temporary_folder.h"

namespace throng {
namespace {

namespace fs = std::filesystem;
using throng::testing::TemporaryFolder;

TEST(Files, ReadsBackTheWrittenBytes) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file_atomically(folder.path() / "deep" / "er" / "file", bytes);
  EXPECT_EQ(read_file(folder.path() / "deep" / "er" / "file"), bytes);
  write_file_atomically(folder.path() / "deep" / "er" / "file", "");
  EXPECT_EQ(read_file(folder.path() / "deep" / "er" / "file"), "");
}

TEST(Files, LinkOrCopyGivesTheSameBytesAndNamesBothFilesOnFailure) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "from", "bytes");
  link_or_copy(folder.path() / "from", folder.path() / "deep" / "to");
  EXPECT_EQ(read_file(folder.path() / "deep" / "to"), "bytes");
  try {
    link_or_copy(folder.path() / "nowhere", folder.path() / "to");
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("nowhere"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find(folder.path() / "to"), std::string::npos);
  }
}

TEST(Files, UnreadableFilesAreFaultsOfTheEnvironment) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_file(folder.path() / "nowhere"), EnvironmentError);
  EXPECT_THROW(read_file(folder.path()), EnvironmentError);
  EXPECT_THROW(read_file("/proc/self/mem"), EnvironmentError) << "an error while reading";
}

TEST(Files, FailedWriteLeavesTheOldContentAndNothingElse) {
  const TemporaryFolder folder;
  // A folder in the file's place cannot be replaced by a file.
  fs::create_directories(folder.path() / "taken" / "by");
  EXPECT_THROW(write_file_atomically(folder.path() / "taken", "x"), EnvironmentError);
  EXPECT_TRUE(fs::is_directory(folder.path() / "taken" / "by"));
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(Files, AFullDiskIsSaid) {
  for (const std::size_t size : {1U, 10'000'000U}) {
    try {
      write_temporary_file("/dev/full", std::string(size, 'x'));
      ADD_FAILURE() << size;
    } catch (const EnvironmentError& error) {
      EXPECT_STREQ(error.what(), "cannot write /dev/full: No space left on device");
    }
  }
  // A library that keeps the reason to itself.
  EXPECT_THROW(throw_write_error("/proc/nowhere/file", 0), EnvironmentError);
  try {
    throw_write_error("a/file", ENOSPC);
  } catch (const EnvironmentError& error) {
    EXPECT_STREQ(error.what(), "cannot write a/file: No space left on device");
  }
}

TEST(Files, PipesAndDevicesAreWrittenDirectly) {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("pipe", folder.path() / "link");
  fs::create_symlink("/dev/null", folder.path() / "null");
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  for (const char* name : {"pipe", "link", "null"}) {
    write_file_atomically(folder.path() / name, "text");
    EXPECT_FALSE(fs::is_regular_file(folder.path() / name)) << name;
  }
  { const StagedFile abandoned(pipe); }
  EXPECT_TRUE(fs::is_fifo(pipe));
  std::array<char, 20> block{};
  EXPECT_EQ(::read(reader, block.data(), block.size()), 8);
  EXPECT_STREQ(block.data(), "texttext");
  ::close(reader);
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(folder.entries(), 3U);
}

TEST(Files, ReaderNeverSeesAPartOfAFile) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "file";
  const std::string a(200'000, 'a');
  const std::string b(100'000, 'b');
  write_file_atomically(path, a);
  std::jthread writer([&] {
    for (int i = 0; i < 20; ++i) write_file_atomically(path, i % 2 == 0 ? b : a);
  });
  for (int i = 0; i < 200; ++i) {
    const std::string seen = read_file(path);
    ASSERT_TRUE(seen == a || seen == b) << seen.size();
  }
}

TEST(StagedFile, AppearsWholeOnCommit) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "deep" / "file";
  {
    StagedFile file(path);
    file.write("half");
    file.flush();
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(read_file(file.path()), "half");
    file.write(" and half");
    file.commit();
  }
  EXPECT_EQ(read_file(path), "half and half");
}

TEST(StagedFile, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  { StagedFile(folder.path() / "file").write("half"); }
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(StagedFile, ThatCannotBeWrittenIsTheEnvironmentsFault) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "file", "x");
  EXPECT_THROW(StagedFile(folder.path() / "file" / "below"), EnvironmentError);
}

TEST(StagingFolder, AppearsWholeOnCommit) {
  const TemporaryFolder folder;
  {
    StagingFolder staging(folder.path() / "done");
    write_file_atomically(staging.path() / "inner" / "file", "content");
    EXPECT_FALSE(fs::exists(folder.path() / "done"));
    staging.commit();
  }
  EXPECT_EQ(read_file(folder.path() / "done" / "inner" / "file"), "content");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(StagingFolder, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  {
    const StagingFolder staging(folder.path() / "done");
    write_file_atomically(staging.path() / "file", "content");
  }
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(StagingFolder, KeepsPublishedFiles) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "done" / "file", "first");
  StagingFolder staging(folder.path() / "done");
  write_file_atomically(staging.path() / "file", "second");
  staging.commit();
  EXPECT_EQ(read_file(folder.path() / "done" / "file"), "first");
}

TEST(StagingFolder, ReplacesExistingFilesWhenAsked) {
  const TemporaryFolder folder;
  for (const char* content : {"first", "second"}) {
    StagingFolder staging(folder.path() / "done");
    write_file_atomically(staging.path() / content, content);
    staging.commit_replacing();
  }
  EXPECT_EQ(read_file(folder.path() / "done" / "second"), "second");
  EXPECT_FALSE(fs::exists(folder.path() / "done" / "first"));
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(StagingFolder, TwoForOnePlaceDoNotMeet) {
  const TemporaryFolder folder;
  const StagingFolder one(folder.path() / "done");
  const StagingFolder two(folder.path() / "done");
  EXPECT_NE(one.path(), two.path());
}

}  // namespace
}  // namespace throng
