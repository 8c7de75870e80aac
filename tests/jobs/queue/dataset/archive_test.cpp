#include "jobs/queue/dataset/archive.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "base/error.h"
#include "base/files/hash.h"
#include "jobs/queue/dataset/manifest.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

std::string read_whole(const Archive& archive, std::size_t block) {
  std::string bytes;
  std::string buffer(block, '?');
  while (const std::size_t count = archive.read(static_cast<std::int64_t>(bytes.size()), buffer)) {
    bytes.append(buffer, 0, count);
  }
  return bytes;
}

struct Member {
  std::string bytes;
  std::int64_t time = -1;
  std::int64_t owner = -1;
};

// As libarchive, which shares no code with the writer, understands it.
std::map<std::string, Member> unpacked(const std::string& tar) {
  const std::unique_ptr<archive, decltype(&archive_read_free)> reader(archive_read_new(),
                                                                      &archive_read_free);
  archive_read_support_format_tar(reader.get());
  EXPECT_EQ(archive_read_open_memory(reader.get(), tar.data(), tar.size()), ARCHIVE_OK);
  std::map<std::string, Member> members;
  archive_entry* entry = nullptr;
  int result = 0;
  while ((result = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK) {
    Member member{std::string(static_cast<std::size_t>(archive_entry_size(entry)), '\0'),
                  archive_entry_mtime(entry), archive_entry_uid(entry)};
    EXPECT_EQ(archive_read_data(reader.get(), member.bytes.data(), member.bytes.size()),
              static_cast<la_ssize_t>(member.bytes.size()));
    members[archive_entry_pathname(entry)] = member;
  }
  EXPECT_EQ(result, ARCHIVE_EOF) << archive_error_string(reader.get());
  return members;
}

class ArchiveTest : public testing::Test {
 protected:
  void add(const std::string& path, const std::string& bytes) {
    write_file_atomically(folder.path() / path, bytes);
    files.push_back(
        {path, static_cast<std::int64_t>(bytes.size()), sha256_hex(bytes), crc32(bytes)});
  }
  void write_manifest() const {
    write_file_atomically(folder.path() / kManifestName, nlohmann::json{{"files", files}}.dump());
  }

  TemporaryFolder folder;
  std::vector<FileEntry> files;
};

TEST_F(ArchiveTest, NamesAreDistinctAndAllowedOnAllSystems) {
  const auto refusal = [&](const std::vector<std::string>& paths) -> std::string {
    files.clear();
    for (const std::string& path : paths) add(path, "x");
    write_manifest();
    for (const ArchiveFormat format : {ArchiveFormat::tar, ArchiveFormat::zip}) {
      try {
        const Archive archive(folder.path(), "square", format);
      } catch (const EnvironmentError& error) {
        if (format == ArchiveFormat::zip) return error.what();
      }
    }
    return "";
  };
  EXPECT_EQ(refusal({"images/a/0.jpg", "images/b/0.jpg"}), "");
  EXPECT_EQ(
      refusal({"images/A/0.jpg", "images/a/0.jpg"}),
      "the dataset's files \"square/images/A\" and \"square/images/a/0.jpg\" cannot be in one "
      "archive: they are one file on Windows and macOS");
  EXPECT_NE(refusal({"x/A.txt", "x/a.TXT"}), "");
  EXPECT_NE(refusal({"Manifest.json"}), "") << "the manifest is a file, too";
  EXPECT_NE(refusal({"images/con/0.jpg"}), "");
  EXPECT_NE(refusal({"cameras/com1.ros.yaml"}), "");
  EXPECT_NE(refusal({"cameras/a:b"}), "");
  EXPECT_NE(refusal({"cameras/a."}), "");
}

TEST_F(ArchiveTest, ReadersFindEveryFileWithItsBytes) {
  add("images/run000/d1/000001.jpg", std::string(1000, 'j'));
  add("empty", "");
  add("block", std::string(512, 'b'));
  add("annotations/instances.json", "{}");
  add(std::string(60, 'd') + "/" + std::string(60, 'e') + "/file", "long path");
  write_manifest();
  const Archive archive(folder.path(), "square");
  const std::string tar = read_whole(archive, 700);
  EXPECT_EQ(static_cast<std::int64_t>(tar.size()), archive.size());
  const auto members = unpacked(tar);
  EXPECT_EQ(members.size(), files.size() + 1);
  for (const FileEntry& file : files) {
    ASSERT_TRUE(members.contains("square/" + file.path)) << file.path;
    const Member& member = members.at("square/" + file.path);
    EXPECT_EQ(sha256_hex(member.bytes), file.sha256);
    EXPECT_EQ(member.time, 0);
    EXPECT_EQ(member.owner, 0);
  }
  EXPECT_TRUE(members.contains("square/manifest.json"));
}

TEST_F(ArchiveTest, EqualFilesAreLinksToTheFirst) {
  const std::string image(20'000, 'p');
  add("formats/yolo/000001.jpg", image);
  add("images/000001.jpg", image);
  add("formats/small", "s");
  add("images/small", "s");
  write_manifest();
  const Archive archive(folder.path(), "square");
  const std::string tar = read_whole(archive, 4096);
  EXPECT_EQ(static_cast<std::int64_t>(tar.size()), archive.size());
  EXPECT_LT(tar.size(), 2 * image.size());
  const std::unique_ptr<struct archive, decltype(&archive_read_free)> reader(archive_read_new(),
                                                                             &archive_read_free);
  archive_read_support_format_tar(reader.get());
  ASSERT_EQ(archive_read_open_memory(reader.get(), tar.data(), tar.size()), ARCHIVE_OK);
  std::map<std::string, std::string> links;
  archive_entry* entry = nullptr;
  while (archive_read_next_header(reader.get(), &entry) == ARCHIVE_OK) {
    const char* target = archive_entry_hardlink(entry);
    links[archive_entry_pathname(entry)] = target == nullptr ? "" : target;
  }
  EXPECT_EQ(links.at("square/formats/yolo/000001.jpg"), "");
  EXPECT_EQ(links.at("square/images/000001.jpg"), "square/formats/yolo/000001.jpg");
  EXPECT_EQ(links.at("square/images/small"), "") << "a link would not be shorter";
}

TEST_F(ArchiveTest, AnyPartIsThatPartOfTheWhole) {
  for (int i = 0; i < 5; ++i) add(fmt::format("f{}", i), std::string(300 * i, 'a' + i));
  write_manifest();
  const Archive archive(folder.path(), "r");
  const std::string whole = read_whole(archive, 1 << 20);
  for (const std::size_t block : {1, 7, 511, 512, 513, 4096}) {
    EXPECT_EQ(read_whole(archive, block), whole) << block;
  }
  std::string rest(100, '?');
  EXPECT_EQ(archive.read(archive.size(), rest), 0U);
  EXPECT_EQ(archive.read(archive.size() - 3, rest), 3U);
}

TEST_F(ArchiveTest, OrderIsByPathWhateverTheManifestSays) {
  add("b", "2");
  add("a", "1");
  write_manifest();
  const std::string one = read_whole(Archive(folder.path(), "r"), 4096);
  std::swap(files[0], files[1]);
  write_manifest();
  const std::string other = read_whole(Archive(folder.path(), "r"), 4096);
  EXPECT_EQ(one.substr(0, 2048), other.substr(0, 2048));
  EXPECT_EQ(one.substr(0, 3), "r/a");
}

TEST_F(ArchiveTest, SizesBeyondTheOctalField) {
  const std::int64_t bytes = std::int64_t{9} << 30;
  write_file_atomically(folder.path() / "big", "");
  std::filesystem::resize_file(folder.path() / "big", static_cast<std::uintmax_t>(bytes));
  files.push_back({"big", bytes, ""});
  write_manifest();
  const Archive archive(folder.path(), "r");
  std::string start(512, '?');
  archive.read(0, start);
  const std::unique_ptr<::archive, decltype(&archive_read_free)> reader(archive_read_new(),
                                                                        &archive_read_free);
  archive_read_support_format_tar(reader.get());
  ASSERT_EQ(archive_read_open_memory(reader.get(), start.data(), start.size()), ARCHIVE_OK);
  archive_entry* entry = nullptr;
  ASSERT_EQ(archive_read_next_header(reader.get(), &entry), ARCHIVE_OK);
  EXPECT_EQ(archive_entry_size(entry), bytes);
}

TEST_F(ArchiveTest, AFileThatShrankIsAnErrorNotSilence) {
  add("a", std::string(1000, 'a'));
  write_manifest();
  const Archive archive(folder.path(), "r");
  write_file_atomically(folder.path() / "a", "short");
  std::string buffer(2000, '?');
  EXPECT_THROW(archive.read(0, buffer), EnvironmentError);
}

TEST_F(ArchiveTest, WithoutManifestThereIsNoDataset) {
  EXPECT_THROW(Archive(folder.path(), "r"), EnvironmentError);
}

// As libarchive's streaming reader understands a zip file.
std::map<std::string, std::string> unzipped(const std::string& zip) {
  const std::unique_ptr<archive, decltype(&archive_read_free)> reader(archive_read_new(),
                                                                      &archive_read_free);
  archive_read_support_format_zip(reader.get());
  EXPECT_EQ(archive_read_open_memory(reader.get(), zip.data(), zip.size()), ARCHIVE_OK);
  std::map<std::string, std::string> members;
  archive_entry* entry = nullptr;
  int result = 0;
  while ((result = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK) {
    std::string bytes(static_cast<std::size_t>(archive_entry_size(entry)), '\0');
    EXPECT_EQ(archive_read_data(reader.get(), bytes.data(), bytes.size()),
              static_cast<la_ssize_t>(bytes.size()))
        << archive_error_string(reader.get());
    members[archive_entry_pathname(entry)] = bytes;
  }
  EXPECT_EQ(result, ARCHIVE_EOF) << archive_error_string(reader.get());
  return members;
}

TEST_F(ArchiveTest, AZipFileHoldsTheSame) {
  add("images/000001.jpg", std::string(20'000, 'p'));
  add("formats/yolo/000001.jpg", std::string(20'000, 'p'));
  add("empty", "");
  write_manifest();
  const Archive archive(folder.path(), "square", ArchiveFormat::zip);
  const std::string zip = read_whole(archive, 1000);
  EXPECT_EQ(static_cast<std::int64_t>(zip.size()), archive.size());
  const auto members = unzipped(zip);
  EXPECT_EQ(members.size(), files.size() + 1);
  for (const FileEntry& file : files) {
    EXPECT_EQ(sha256_hex(members.at("square/" + file.path)), file.sha256) << file.path;
  }
  for (const std::size_t block : {1, 7, 4096}) EXPECT_EQ(read_whole(archive, block), zip) << block;
}

/// Lets libarchive go where it likes in an archive, as a program does in a file.
struct Seekable {
  const Archive* source = nullptr;
  std::int64_t place = 0;
  std::string buffer = std::string(1 << 16, '\0');

  static la_ssize_t read(archive*, void* self, const void** data) {
    auto& file = *static_cast<Seekable*>(self);
    const std::size_t count = file.source->read(file.place, file.buffer);
    file.place += static_cast<std::int64_t>(count);
    *data = file.buffer.data();
    return static_cast<la_ssize_t>(count);
  }
  static la_int64_t seek(archive*, void* self, la_int64_t offset, int whence) {
    auto& file = *static_cast<Seekable*>(self);
    const std::int64_t from = whence == SEEK_SET   ? 0
                              : whence == SEEK_CUR ? file.place
                                                   : file.source->size();
    return file.place = from + offset;
  }
};

TEST_F(ArchiveTest, ZipFilesGoOnBeyondFourGigabytesAndSixtyFiveThousandFiles) {
  const std::int64_t bytes = std::int64_t{5} << 30;
  write_file_atomically(folder.path() / "big", "");
  std::filesystem::resize_file(folder.path() / "big", static_cast<std::uintmax_t>(bytes));
  files.push_back({"big", bytes, "", 0});
  constexpr int kFiles = 70'000;
  for (int i = 0; i < kFiles; ++i) files.push_back({fmt::format("c/{:06}", i), 0, "", 0});
  add("last", "behind it all");
  write_manifest();
  const Archive whole(folder.path(), "r", ArchiveFormat::zip);
  EXPECT_GT(whole.size(), bytes);
  Seekable file{&whole};
  const std::unique_ptr<archive, decltype(&archive_read_free)> reader(archive_read_new(),
                                                                      &archive_read_free);
  archive_read_support_format_zip_seekable(reader.get());
  archive_read_set_callback_data(reader.get(), &file);
  archive_read_set_read_callback(reader.get(), &Seekable::read);
  archive_read_set_seek_callback(reader.get(), &Seekable::seek);
  ASSERT_EQ(archive_read_open1(reader.get()), ARCHIVE_OK) << archive_error_string(reader.get());
  std::int64_t count = 0;
  archive_entry* entry = nullptr;
  while (archive_read_next_header(reader.get(), &entry) == ARCHIVE_OK) {
    ++count;
    const std::string path = archive_entry_pathname(entry);
    EXPECT_TRUE(path != "r/big" || archive_entry_size(entry) == bytes);
    if (path != "r/last") continue;
    std::string text(13, '?');
    EXPECT_EQ(archive_read_data(reader.get(), text.data(), text.size()), 13);
    EXPECT_EQ(text, "behind it all");
  }
  EXPECT_EQ(count, kFiles + 3);
}

TEST_F(ArchiveTest, ASelectionHoldsTheChosenFilesAndTheManifest) {
  add("images/run000/a.jpg", "0");
  add("images/run001/a.jpg", "1");
  add("depth/run000/a.png", "2");
  write_manifest();
  const Archive archive(folder.path(), "r", ArchiveFormat::zip, {{"images"}, {1}});
  const auto members = unzipped(read_whole(archive, 4096));
  EXPECT_EQ(members.size(), 2U);
  EXPECT_EQ(members.at("r/images/run001/a.jpg"), "1");
  EXPECT_TRUE(members.contains("r/manifest.json"));
}

TEST_F(ArchiveTest, ADatasetWithoutChecksumsCannotBeAZipFile) {
  add("a", "1");
  files[0].crc32.reset();
  write_manifest();
  EXPECT_THROW(Archive(folder.path(), "r", ArchiveFormat::zip), EnvironmentError);
  EXPECT_NO_THROW(Archive(folder.path(), "r", ArchiveFormat::tar));
}

}  // namespace
}  // namespace throng::jobs
