#include "base/files/unpack.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <zlib.h>

#include <fstream>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/untrusted_folders.h"
#include "tests/base/packed.h"

namespace throng {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using throng::testing::packed;
using throng::testing::PackedEntry;
using throng::testing::Packing;

class Unpacking : public ::testing::Test {
 protected:
  Unpacking() {
    std::string name = (fs::temp_directory_path() / "throng-unpack-XXXXXX").string();
    outer = ::mkdtemp(name.data());
    folder = outer / "inner";
    fs::create_directories(folder);
  }
  ~Unpacking() override { fs::remove_all(outer); }

  /// Location and value that are refused; "" when nothing is.
  std::string refusal_of(const std::string& bytes, const UnpackLimits& limits = {}) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    try {
      unpack_archive(bytes, folder, limits);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::string refusal_of(const std::vector<PackedEntry>& entries, const UnpackLimits& limits = {}) {
    return refusal_of(packed(Packing::tar, entries), limits);
  }

  fs::path outer;
  fs::path folder;
};

// As a process may leave them that was taken over.
TEST_F(Unpacking, ACopyTakesPlainFilesAndFoldersOnly) {
  const fs::path theirs = outer / "theirs";
  distrust_folders_in(outer);
  const auto refusal = [&](const UnpackLimits& limits = {}) -> std::string {
    fs::remove_all(folder);
    fs::create_directories(folder);
    try {
      copy_unpacked(theirs, folder, limits);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto begin = [&] {
    fs::remove_all(theirs);
    fs::create_directories(theirs / "a/b");
    std::ofstream(theirs / "a/b/one.txt") << "one";
    std::ofstream(theirs / "two.txt") << "two";
  };
  begin();
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(read_file(folder / "a/b/one.txt"), "one");
  const Unpacked copied = copy_unpacked(theirs, folder);
  EXPECT_EQ(copied.files, 2U);
  EXPECT_EQ(copied.bytes, 6);
  EXPECT_THAT(refusal({.max_file_bytes = 2}), HasSubstr("at most 2 bytes"));
  EXPECT_THAT(refusal({.max_bytes = 5}), HasSubstr("a larger file"));
  EXPECT_THAT(refusal({.max_folders = 1}), HasSubstr("more files or folders"));
  EXPECT_THAT(refusal({.max_depth = 2}), HasSubstr("a path of 3 levels"));
  fs::create_symlink("/etc/hostname", theirs / "link");
  EXPECT_THAT(refusal(), HasSubstr("\"link\": found no plain file"));
  begin();
  fs::create_symlink("/etc", theirs / "folder");
  EXPECT_THAT(refusal(), HasSubstr("\"folder\": found no plain file"));
  begin();
  ASSERT_EQ(::mkfifo((theirs / "pipe").c_str(), 0644), 0);
  EXPECT_THAT(refusal(), HasSubstr("\"pipe\": found no plain file"));
  begin();
  std::ofstream(theirs / "line\nbreak") << "x";
  EXPECT_THAT(refusal(), HasSubstr("this path"));
  begin();
  std::ofstream(theirs / "TWO.txt") << "x";
  EXPECT_THAT(refusal(), HasSubstr("differ in more than their case"));
  fs::remove_all(theirs);
  fs::create_directories(theirs / "only");
  EXPECT_THAT(refusal(), HasSubstr("no file"));
}

std::string gzipped(const std::string& text) {
  z_stream stream{};
  constexpr int kWithGzipHeader = 15 + 16;
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWithGzipHeader, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, text.size()), '\0');
  std::string in = text;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

TEST_F(Unpacking, FilesAndFoldersOfEveryKindOfArchive) {
  const std::string text(100'000, 'x');
  for (const Packing packing : {Packing::tar, Packing::tar_gz, Packing::zip, Packing::zip_stored}) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    const Unpacked unpacked = unpack_archive(
        packed(packing, {{"./a.json", "{}"}, {"sub/", "", AE_IFDIR}, {"sub/b c.xml", text}}),
        folder);
    EXPECT_EQ(unpacked.files, 2U);
    EXPECT_EQ(unpacked.bytes, 100'002);
    EXPECT_EQ(read_file(folder / "a.json"), "{}");
    EXPECT_EQ(read_file(folder / "sub/b c.xml"), text);
  }
}

TEST_F(Unpacking, NamesThatLeadElsewhereAreRefused) {
  for (const char* name :
       {"../x", "a/../../x", "/etc/x", "a\\..\\x", "c:x", "a/..", "x.", " x", "con", "Aux.txt",
        "LPT1", "tab\there", "\x1b[31m", "ge\xc3\xb6", "\xff", "a*", "pipe|"}) {
    EXPECT_THAT(refusal_of({{name, "x"}}), HasSubstr("expected")) << name;
  }
  EXPECT_EQ(refusal_of({{"com/console/nullable.txt", "x"}}), "");
  EXPECT_FALSE(fs::exists(outer / "x"));
  UnpackLimits limits;
  limits.max_path_bytes = 10;
  limits.max_depth = 2;
  EXPECT_THAT(refusal_of({{"12345678901", "x"}}, limits), HasSubstr("at most 10"));
  EXPECT_THAT(refusal_of({{"a/b/c", "x"}}, limits), HasSubstr("at most 2"));
}

TEST_F(Unpacking, AByteZeroInAZipsNameIsRefused) {
  std::string zip = packed(Packing::zip_stored, {{"aXb", "hello"}});
  for (std::size_t at = zip.find("aXb"); at != std::string::npos; at = zip.find("aXb", at)) {
    zip[at + 1] = '\0';
  }
  const std::string refusal = refusal_of(zip);
  // The library ends names there; what matters is that nothing else is written.
  EXPECT_TRUE(!refusal.empty() || fs::exists(folder / "a"));
}

TEST_F(Unpacking, LinksAndDevicesAreRefused) {
  EXPECT_THAT(refusal_of({{"a", "", AE_IFLNK, "/etc/passwd"}}), HasSubstr("\"a\": found a link"));
  EXPECT_THAT(refusal_of({{"a", "x"}, {"b", "", AE_IFREG, "", "a"}}), HasSubstr("a link"));
  EXPECT_THAT(refusal_of({{"a", "", AE_IFIFO}}), HasSubstr("special file"));
  EXPECT_THAT(refusal_of({{"a", "", AE_IFCHR}}), HasSubstr("special file"));
  EXPECT_THAT(refusal_of(packed(Packing::zip, {{"a", "", AE_IFLNK, "../../x"}, {"a/passwd", "x"}})),
              HasSubstr("a link"));
}

TEST_F(Unpacking, NamesThatDifferInTheirCaseOnlyAreRefused) {
  EXPECT_THAT(refusal_of({{"a/B.xml", "1"}, {"A/c.xml", "2"}}), HasSubstr("case"));
  EXPECT_THAT(refusal_of({{"a", "1"}, {"a", "2"}}), HasSubstr("again"));
  EXPECT_THAT(refusal_of({{"a", "1"}, {"a/b", "2"}}), HasSubstr("again"));
  EXPECT_EQ(refusal_of({{"a/", "", AE_IFDIR}, {"a/b", "2"}, {"a/", "", AE_IFDIR}}), "");
}

TEST_F(Unpacking, BombsAreRefusedEarly) {
  UnpackLimits limits;
  limits.max_entries = 3;
  EXPECT_THAT(refusal_of({{"1"}, {"2"}, {"3"}, {"4"}}, limits), HasSubstr("at most 3"));
  limits = {};
  limits.max_folders = 3;
  EXPECT_EQ(refusal_of({{"a/b/c/1"}, {"a/b/2"}}, limits), "");
  EXPECT_THAT(refusal_of({{"a/b/c/1"}, {"a/d/2"}}, limits), HasSubstr("more than 3 folders"));
  limits = {};
  limits.max_file_bytes = 1000;
  EXPECT_THAT(refusal_of({{"a", std::string(1001, 'x')}}, limits), HasSubstr("at most 1000 bytes"));
  limits = {};
  limits.max_bytes = 1500;
  const std::string kilobyte(1000, 'x');
  EXPECT_THAT(refusal_of({{"a", kilobyte}, {"b", kilobyte}}, limits), HasSubstr("together"));
  const std::string zeros(20 << 20, '\0');
  EXPECT_THAT(refusal_of(packed(Packing::zip, {{"a", zeros}})), HasSubstr("packed too well"));
  EXPECT_THAT(refusal_of(packed(Packing::tar_gz, {{"a", zeros}})), HasSubstr("packed too well"));
  EXPECT_THAT(refusal_of(packed(Packing::tar_gz, {{"__MACOSX/a", zeros}, {"b", "x"}})),
              HasSubstr("packed too well"));
  EXPECT_EQ(refusal_of(packed(Packing::tar, {{"a", zeros}})), "");
  EXPECT_THAT(refusal_of(gzipped(packed(Packing::tar_gz, {{"a", "x"}}))),
              HasSubstr("several times"));
}

TEST_F(Unpacking, DamagedAndForeignFilesAreRefused) {
  for (const std::string& bytes :
       {std::string(), std::string("x"), std::string("{}"), std::string(10'000, '\0'),
        std::string("Rar!\x1a\x07\x01\x00", 8), packed(Packing::zip, {}),
        packed(Packing::tar, {{"a/", "", AE_IFDIR}})}) {
    EXPECT_NE(refusal_of(bytes), "");
  }
  const std::string text(50'000, 'y');
  for (const Packing packing : {Packing::tar, Packing::tar_gz, Packing::zip}) {
    const std::string whole = packed(packing, {{"a", text}, {"b", text}});
    EXPECT_NE(refusal_of(whole.substr(0, whole.size() / 3)), "");
  }
  // An entry marked as encrypted: bit 0 of the flags, in both of its headers.
  std::string zip = packed(Packing::zip_stored, {{"a", "hello"}});
  constexpr std::size_t kLocalFlags = 6;
  constexpr std::size_t kCentralFlags = 8;
  zip[kLocalFlags] = static_cast<char>(zip[kLocalFlags] | 1);
  const std::size_t central = zip.find("PK\x01\x02");
  zip[central + kCentralFlags] = static_cast<char>(zip[central + kCentralFlags] | 1);
  EXPECT_THAT(refusal_of(zip), HasSubstr("encrypted"));
  // Compressed by a method whose reader allocates what the file requests: LZMA is 14.
  zip = packed(Packing::zip_stored, {{"a", "hello"}});
  constexpr std::size_t kLocalMethod = 8;
  constexpr std::size_t kCentralMethod = 10;
  zip[kLocalMethod] = 14;
  zip[zip.find("PK\x01\x02") + kCentralMethod] = 14;
  EXPECT_THAT(refusal_of(zip), HasSubstr("stored or deflated"));
}

TEST_F(Unpacking, FilesOfMacOsAreLeftOut) {
  EXPECT_EQ(
      unpack_archive(
          packed(Packing::zip, {{"a", "x"}, {"__MACOSX/._a", "y"}, {"sub/.DS_Store", "z"}}), folder)
          .files,
      1U);
  EXPECT_FALSE(fs::exists(folder / "__MACOSX"));
  EXPECT_FALSE(fs::exists(folder / "sub"));
}

}  // namespace
}  // namespace throng
