// Files of baked light.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/files/files.h"
#include "render/light/light_store.h"
#include "tests/world/temporary_folder.h"

namespace throng::render {
namespace {

namespace fs = std::filesystem;

std::vector<float> numbers(std::size_t count) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = 0.25F * static_cast<float>(i % 1000);
  return values;
}

class LightStore : public ::testing::Test {
 protected:
  std::vector<float> get(const std::string& key, std::size_t count) {
    return load_or_make(folder_, key, count, [&] {
      ++made_;
      return numbers(count);
    });
  }
  throng::testing::TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path();
  int made_ = 0;
};

TEST_F(LightStore, MakesOnceWhatIsAskedForTwice) {
  EXPECT_EQ(get("a", 100), numbers(100));
  EXPECT_EQ(get("a", 100), numbers(100));
  EXPECT_EQ(made_, 1);
  EXPECT_EQ(get("b", 10), numbers(10));
  EXPECT_EQ(made_, 2);
}

TEST_F(LightStore, MakesADamagedFileAgain) {
  get("a", 100);
  const fs::path file = folder_ / "a.light";
  const std::string whole = read_file(file);
  for (const std::size_t at : {std::size_t{0}, std::size_t{201}, whole.size() - 1}) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    write_file_atomically(file, damaged);
    const int before = made_;
    EXPECT_EQ(get("a", 100), numbers(100));
    EXPECT_EQ(made_, before + 1) << at;
    EXPECT_EQ(read_file(file), whole);
  }
  write_file_atomically(file, whole.substr(0, 77));
  EXPECT_EQ(get("a", 100), numbers(100));
  fs::remove(file);
  fs::create_symlink("/etc/passwd", file);
  EXPECT_EQ(get("a", 100), numbers(100)) << "a link is nothing that this wrote";
  EXPECT_EQ(read_file(file), whole);
}

TEST_F(LightStore, OneOfManyProcessesMakes) {
  // Each that makes adds a byte to a file.
  const fs::path count = folder_ / "count";
  write_file_atomically(count, "");
  constexpr int kProcesses = 6;
  for (int i = 0; i < kProcesses; ++i) {
    if (::fork() != 0) continue;
    const std::vector<float> values = load_or_make(folder_, "shared", 5000, [&] {
      std::ofstream(count, std::ios::app) << 'x';
      return numbers(5000);
    });
    std::_Exit(values == numbers(5000) ? 0 : 1);
  }
  for (int i = 0; i < kProcesses; ++i) {
    int status = 0;
    ASSERT_GT(::wait(&status), 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(read_file(count), "x");
}

TEST_F(LightStore, TheOldestGoWhenTheFolderIsFull) {
  constexpr std::size_t kCount = std::size_t{12} << 20U;  // 24 MiB
  get("first", kCount);
  const auto hour = std::chrono::hours(1);
  fs::last_write_time(folder_ / "first.light", fs::last_write_time(folder_ / "first.light") - hour);
  get("second", kCount);
  EXPECT_TRUE(fs::exists(folder_ / "first.light"));
  get("third", kCount);
  EXPECT_FALSE(fs::exists(folder_ / "first.light"));
  EXPECT_TRUE(fs::exists(folder_ / "second.light"));
  EXPECT_TRUE(fs::exists(folder_ / "third.light"));
}

TEST_F(LightStore, AFileThatCannotBeWrittenIsAnErrorThatNamesIt) {
  write_file_atomically(folder_ / "blocked", "a file, no folder");
  try {
    load_or_make(folder_ / "blocked", "a", 10, [] { return numbers(10); });
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("blocked"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace throng::render
