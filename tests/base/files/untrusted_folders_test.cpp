#include "base/files/untrusted_folders.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "tests/world/temporary_folder.h"

namespace throng {
namespace {

namespace fs = std::filesystem;

/// A secret beside an area in which somebody else writes.
class UntrustedFoldersTest : public ::testing::Test {
 protected:
  UntrustedFoldersTest() {
    write_file_atomically(secret, "secret");
    write_file_atomically(theirs / "logs/good.log", "good");
    distrust_folders_in(area);
  }

  static int error_of_reading(const fs::path& file) {
    const int descriptor = open_for_reading(file);
    if (descriptor < 0) return errno;
    ::close(descriptor);
    return 0;
  }

  throng::testing::TemporaryFolder base;
  fs::path secret = base.path() / "keys.sqlite";
  fs::path area = base.path() / "jobs";
  fs::path theirs = area / "mine";
};

TEST_F(UntrustedFoldersTest, FilesAreReadAndAppendedTo) {
  EXPECT_EQ(read_file(theirs / "logs/good.log"), "good");
  EXPECT_EQ(read_file(theirs / "logs/../logs/good.log"), "good");
  const int descriptor = open_for_appending(theirs / "logs/new.log");
  ASSERT_GE(descriptor, 0);
  EXPECT_EQ(::write(descriptor, "new", 3), 3);
  ::close(descriptor);
  EXPECT_EQ(read_file(theirs / "logs/new.log"), "new");
  EXPECT_TRUE(exists_without_links(theirs / "logs"));
  EXPECT_FALSE(exists_without_links(theirs / "nothing"));
  EXPECT_EQ(error_of_reading(theirs / "nothing"), ENOENT);
}

TEST_F(UntrustedFoldersTest, LinksAreNotFollowedAtAnyPartOfAPath) {
  fs::create_symlink(secret, theirs / "logs/x");
  fs::create_directory_symlink(base.path(), theirs / "above");
  fs::create_symlink("good.log", theirs / "logs/beside");
  fs::create_directory_symlink(base.path(), area / "whole");
  for (const fs::path& file : {theirs / "logs/x", theirs / "above/keys.sqlite",
                               theirs / "logs/beside", area / "whole/keys.sqlite"}) {
    EXPECT_EQ(error_of_reading(file), ELOOP) << file;
    EXPECT_FALSE(exists_without_links(file)) << file;
    EXPECT_THROW(read_file(file), EnvironmentError) << file;
    EXPECT_THROW(sha256_hex_of_file(file), EnvironmentError) << file;
    EXPECT_LT(open_for_appending(file), 0) << file;
  }
  EXPECT_EQ(read_file(secret), "secret");
}

TEST_F(UntrustedFoldersTest, PipesAndFoldersAreNoFiles) {
  ASSERT_EQ(::mkfifo((theirs / "pipe").c_str(), 0644), 0);
  EXPECT_EQ(error_of_reading(theirs / "pipe"), EACCES);
  EXPECT_EQ(error_of_reading(theirs / "logs"), EISDIR);
}

TEST_F(UntrustedFoldersTest, LinksElsewhereAreFollowed) {
  fs::create_symlink(secret, base.path() / "link");
  EXPECT_EQ(read_file(base.path() / "link"), "secret");
}

}  // namespace
}  // namespace throng
