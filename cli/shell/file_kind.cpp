#include "cli/shell/file_kind.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "base/error.h"
#include "base/files/files.h"
#include "cli/shell/document_kind.h"
#include "cli/shell/input_file.h"

namespace throng::cli {

namespace fs = std::filesystem;

namespace {

constexpr const char* kTrace = "a trace (HDF5)";
constexpr std::string_view kHdf5Signature = "\x89HDF\r\n\x1a\n";

std::string read_beginning(const fs::path& file) {
  std::string bytes(kHdf5Signature.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

bool is_hdf5(const fs::path& file) { return read_beginning(file) == kHdf5Signature; }

[[noreturn]] void refuse(const fs::path& file, std::string found, std::string expected) {
  throw InputError({file.string(), "", std::move(found), std::move(expected)});
}

void refuse_folder(const fs::path& folder) {
  constexpr const char* kFirstTrace = "work/run000/trace.h5";
  if (fs::exists(folder / kFirstTrace)) {
    refuse(folder, "the folder of a job",
           fmt::format("{}, such as {}", kTrace, (folder / kFirstTrace).string()));
  }
  if (fs::exists(folder / "manifest.json")) {
    refuse(folder, "a dataset",
           fmt::format("{}; its figures are in {}", kTrace, (folder / "metrics.json").string()));
  }
  refuse(folder, "a folder", kTrace);
}

bool is_recording(const fs::path& file) {
  constexpr std::array<std::string_view, 6> kEndings = {".csv",    ".tsv", ".txt",
                                                        ".sqlite", ".scb", ".db"};
  return std::find(kEndings.begin(), kEndings.end(), file.extension().string()) != kEndings.end();
}

DocumentKind kind_of_json(const fs::path& file) {
  if (file.extension() != ".json") return DocumentKind::unknown;
  return document_kind(read_input_file(file.string(), kTrace), file.string());
}

}  // namespace

void require_trace(const fs::path& file) {
  check_input_file(file.string(), kTrace);
  if (fs::is_directory(file)) refuse_folder(file);
  if (!fs::is_regular_file(file)) refuse(file, "a device", kTrace);
  if (is_hdf5(file)) return;
  if (const DocumentKind kind = kind_of_json(file); kind == DocumentKind::job) {
    refuse(file, "a job",
           fmt::format("{}; `throng simulate {} -o RUN.h5` makes one", kTrace, file.string()));
  } else if (kind != DocumentKind::unknown) {
    refuse(file, std::string(to_string(kind)), kTrace);
  }
  if (is_recording(file)) {
    refuse(file, "a table",
           fmt::format("{}; `throng metrics --trajectory {} --scenario ID` measures recorded "
                       "people",
                       kTrace, file.string()));
  }
}

void refuse_as_trajectory(const fs::path& file) {
  constexpr const char* kExpected = "a file of trajectories";
  check_input_file(file.string(), kExpected);
  if (fs::is_directory(file)) refuse(file, "a folder", kExpected);
  const DocumentKind kind = kind_of_json(file);
  if (kind != DocumentKind::unknown) refuse(file, std::string(to_string(kind)), kExpected);
}

void check_ending(const std::string& option, const fs::path& file,
                  std::initializer_list<std::string_view> endings) {
  const std::string ending = file.extension().string();
  const bool is_device = fs::exists(file) && !fs::is_regular_file(file) && !fs::is_directory(file);
  if (file.empty() || is_device ||
      std::find(endings.begin(), endings.end(), ending) != endings.end()) {
    return;
  }
  throw InputError({option, "", file.string(),
                    fmt::format("a file whose name ends with {}", fmt::join(endings, " or "))});
}

}  // namespace throng::cli
