#include "jobs/queue/pinned_library.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"

namespace throng::jobs {
namespace {

namespace fs = std::filesystem;

class PinnedPeopleTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder.path());
    fs::create_directories(folder.path());
  }
  void TearDown() override { fs::remove_all(folder.path()); }

  JobFolder folder{fs::path(testing::TempDir()) /
                   testing::UnitTest::GetInstance()->current_test_info()->name()};
};

TEST_F(PinnedPeopleTest, TheFirstWorkerDecides) {
  EXPECT_EQ(pinned_library(folder), "");
  pin_library(folder, "abc");
  EXPECT_EQ(pinned_library(folder), "abc");
  EXPECT_NO_THROW(pin_library(folder, "abc"));
}

TEST_F(PinnedPeopleTest, OtherPeopleAreRefusedNamingBoth) {
  pin_library(folder, "0123");
  try {
    pin_library(folder, "4567");
    FAIL() << "no error";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("0123"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("4567"), std::string::npos) << error.what();
  }
  EXPECT_EQ(pinned_library(folder), "0123");
}

TEST_F(PinnedPeopleTest, NothingIsLeftBehindBesideTheNote) {
  pin_library(folder, "abc");
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path() / "work")) {
    EXPECT_EQ(entry.path().filename(), "people");
    ++files;
  }
  EXPECT_EQ(files, 1);
}

}  // namespace
}  // namespace throng::jobs
