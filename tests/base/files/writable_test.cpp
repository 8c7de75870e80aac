#include "base/files/writable.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <string>

#include "base/error.h"
#include "base/files/files.h"

namespace throng {
namespace {

namespace fs = std::filesystem;

constexpr uid_t kNobody = 65534;

/// Runs tests as somebody to whom permissions apply.
class Writable : public ::testing::Test {
 protected:
  Writable() : folder_(fs::path(::testing::TempDir()) / "writable_test") {
    fs::remove_all(folder_);
    for (const char* name : {"own", "locked", "locked/inner"})
      fs::create_directories(folder_ / name);
    write_file_atomically(folder_ / "file", "");
    write_file_atomically(folder_ / "own/locked.sqlite", "");
    write_file_atomically(folder_ / "own/half.sqlite", "");
    write_file_atomically(folder_ / "own/half.sqlite-wal", "");
    fs::create_directory(folder_ / "own/folder.sqlite");
    for (const char* name : {"own", "own/half.sqlite", "own/folder.sqlite"}) {
      fs::permissions(folder_ / name, fs::perms::all);
    }
    for (const char* name : {"locked/inner", "locked"}) {
      fs::permissions(folder_ / name, fs::perms(0555));
    }
    for (const char* name : {"file", "own/locked.sqlite", "own/half.sqlite-wal"}) {
      fs::permissions(folder_ / name, fs::perms(0444));
    }
    if (::geteuid() == 0 && ::seteuid(kNobody) != 0) ADD_FAILURE();
  }
  ~Writable() override {
    EXPECT_EQ(::seteuid(::getuid()), 0);
    for (const char* name : {"locked", "locked/inner"}) {
      fs::permissions(folder_ / name, fs::perms::all);
    }
    fs::remove_all(folder_);
  }

  /// The error about a path in the folder, without the folder's own path; "" if there is none.
  std::string refusal(const std::string& name, const std::function<void(const fs::path&)>& check) {
    try {
      check(folder_ / name);
    } catch (const EnvironmentError& error) {
      std::string text = error.what();
      for (std::size_t at = 0; (at = text.find(folder_.string() + "/")) != std::string::npos;) {
        text.erase(at, folder_.string().size() + 1);
      }
      return text;
    }
    return "";
  }

  const fs::path folder_;
};

TEST_F(Writable, FoldersSayWhatIsWrongWithThem) {
  const std::string denied = fmt::format("Permission denied (user {})", ::geteuid());
  EXPECT_EQ(refusal("own", require_writable_folder), "");
  EXPECT_EQ(refusal("locked", require_writable_folder), "cannot write to locked: " + denied);
  EXPECT_EQ(refusal("file", require_writable_folder),
            "cannot write to file: found a file, expected a folder");
  EXPECT_EQ(refusal("absent", require_writable_folder),
            "cannot write to absent: No such file or directory");
  EXPECT_EQ(refusal("locked/a/b", make_folders), "cannot write to locked: " + denied);
  EXPECT_EQ(refusal("file/a/b", make_folders),
            "cannot write to file: found a file, expected a folder");
  const auto write = [](const fs::path& path) { write_file_atomically(path, "text"); };
  EXPECT_EQ(refusal("locked/text", write), "cannot write to locked: " + denied);
  EXPECT_EQ(refusal("file/text", write), "cannot write to file: found a file, expected a folder");
  EXPECT_EQ(refusal("locked/folder", [](const fs::path& path) { StagingFolder{path}; }),
            "cannot write to locked: " + denied);
}

TEST_F(Writable, DatabasesAreFilesWithOthersBesideThem) {
  const std::string denied = fmt::format("Permission denied (user {})", ::geteuid());
  const auto database = [](const fs::path& path) { require_writable_database(path); };
  EXPECT_EQ(refusal("own/new.sqlite", database), "");
  EXPECT_EQ(refusal("locked/new.sqlite", database), "cannot write to locked: " + denied);
  EXPECT_EQ(refusal("own/locked.sqlite", database), "cannot write to own/locked.sqlite: " + denied);
  EXPECT_EQ(refusal("own/half.sqlite", database), "cannot write to own/half.sqlite-wal: " + denied);
  EXPECT_EQ(refusal("own/folder.sqlite", database),
            "cannot write to own/folder.sqlite: found a folder, expected a file");
}

}  // namespace
}  // namespace throng
