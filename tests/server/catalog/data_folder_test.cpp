#include "server/catalog/data_folder.h"

#include <gtest/gtest.h>

#include <chrono>

#include "base/files/files.h"
#include "tests/jobs/yard.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;

TEST(DataFolder, FoldersUnknownToTheStoreAreMovedAwayAndKept) {
  const jobs::TemporaryFolder data;
  jobs::Store store(data.path());
  const std::string known = store.add({.name = "a"}).row.id;
  write_file_atomically(data.path() / "jobs" / known / "work/a", "mine");
  write_file_atomically(data.path() / "jobs/jstranger/work/a", "whose?");
  write_file_atomically(data.path() / "calibrations/cstranger/a", "whose?");
  write_file_atomically(data.path() / "trash/x/a", "half removed");
  tidy_data_folder(data.path(), store);
  EXPECT_TRUE(fs::exists(data.path() / "jobs" / known / "work/a"));
  EXPECT_FALSE(fs::exists(data.path() / "jobs/jstranger"));
  EXPECT_EQ(read_file(data.path() / "quarantine/jobs/jstranger/work/a"), "whose?");
  EXPECT_EQ(read_file(data.path() / "quarantine/calibrations/cstranger/a"), "whose?");
  EXPECT_FALSE(fs::exists(data.path() / "trash"));
}

TEST(DataFolder, AMonthLaterItIsRemoved) {
  const jobs::TemporaryFolder data;
  const jobs::Store store(data.path());
  const fs::path old_folder = data.path() / "quarantine/jobs/jold";
  write_file_atomically(old_folder / "a", "1");
  write_file_atomically(data.path() / "quarantine/jobs/jyoung/a", "1");
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(old_folder, now - std::chrono::hours(24 * 31));
  tidy_data_folder(data.path(), store);
  EXPECT_FALSE(fs::exists(old_folder));
  EXPECT_TRUE(fs::exists(data.path() / "quarantine/jobs/jyoung/a"));
}

}  // namespace
}  // namespace throng::server
