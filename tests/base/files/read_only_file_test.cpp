#include "base/files/read_only_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "base/error.h"
#include "base/files/files.h"

namespace throng {
namespace {

TEST(ReadOnlyFile, IsReadAtAnyOffset) {
  const auto path =
      std::filesystem::temp_directory_path() / ("throng_ro_" + std::to_string(::getpid()));
  write_file_atomically(path, "0123456789");
  const ReadOnlyFile file(path);
  std::filesystem::remove(path);  // it stays open
  EXPECT_EQ(file.size(), 10);
  EXPECT_GT(file.changed_ns(), 0);
  std::array<char, 4> buffer{};
  EXPECT_EQ(file.read_at(3, buffer), 4U);
  EXPECT_EQ(std::string_view(buffer.data(), 4), "3456");
  EXPECT_EQ(file.read_at(8, buffer), 2U);
  EXPECT_EQ(file.read_at(99, buffer), 0U);
}

TEST(ReadOnlyFile, OneThatIsNotThereIsTheMachinesFault) {
  EXPECT_THROW(ReadOnlyFile("/nonexistent/file"), EnvironmentError);
}

}  // namespace
}  // namespace throng
