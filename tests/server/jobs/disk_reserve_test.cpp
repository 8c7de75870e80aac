#include "server/jobs/disk_reserve.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/files/files.h"

namespace throng::server {
namespace {

class DiskReserveTest : public ::testing::Test {
 protected:
  /// Bytes that the reserve has on the disk; -1: there is no file.
  std::int64_t kept() const {
    struct stat status {};
    if (::stat((folder_.path() / "reserve").c_str(), &status) != 0) return -1;
    constexpr std::int64_t kBlockBytes = 512;  // of st_blocks, whatever the disk's
    return status.st_blocks * kBlockBytes;
  }

  StagingFolder folder_{std::filesystem::temp_directory_path() / "throng-reserve"};
};

TEST_F(DiskReserveTest, IsFreeAtTheStartAndThenKept) {
  write_file_atomically(folder_.path() / "reserve", "of a process that was killed");
  DiskReserve reserve(folder_.path());
  EXPECT_EQ(kept(), -1);
  { const auto use = reserve.free(); }
  EXPECT_EQ(kept(), -1) << "the start has not ended";
  reserve.started();
  EXPECT_GE(kept(), DiskReserve::kBytes);
}

TEST_F(DiskReserveTest, IsFreeUntilTheLastUserEnds) {
  DiskReserve reserve(folder_.path());
  reserve.started();
  auto first = reserve.free();
  auto second = reserve.free();
  EXPECT_EQ(kept(), -1);
  first.reset();
  EXPECT_EQ(kept(), -1);
  second.reset();
  EXPECT_GE(kept(), DiskReserve::kBytes);
}

TEST_F(DiskReserveTest, FoldersThatDoNotExistAreIgnored) {
  DiskReserve reserve(folder_.path() / "missing");
  reserve.started();
  EXPECT_NO_THROW(reserve.free());
}

}  // namespace
}  // namespace throng::server
