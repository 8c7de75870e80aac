#include "base/files/unpack.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/read_only_file.h"
#include "base/resource_exhaustion.h"
#include "base/text/portable_name.h"

namespace throng {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSource = "bundle";
constexpr const char* kPlainName =
    "a relative path of printable ASCII characters without \\ : * ? \" < > |";

using ArchiveHandle = std::unique_ptr<archive, int (*)(archive*)>;

std::string printable(std::string_view text) {
  constexpr std::size_t kMaxPrintedBytes = 120;
  std::string out;
  for (const char c : text.substr(0, kMaxPrintedBytes)) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte >= ' ' && byte < 0x7F ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
  }
  return text.size() > kMaxPrintedBytes ? out + "..." : out;
}

[[noreturn]] void refuse(std::string_view entry, std::string found, std::string expected) {
  throw InputError(Problem{kSource, entry.empty() ? "" : fmt::format("\"{}\"", printable(entry)),
                           std::move(found), std::move(expected)});
}

/// An entry's path in its parts. Throws InputError.
std::vector<std::string> split_path(std::string_view name, const UnpackLimits& limits) {
  if (name.size() > limits.max_path_bytes) {
    refuse(name, fmt::format("a path of {} characters", name.size()),
           fmt::format("at most {}", limits.max_path_bytes));
  }
  if (auto fault = path_fault(name)) refuse(name, std::move(*fault), kPlainName);
  std::vector<std::string> parts;
  for (std::size_t from = 0; from < name.size();) {
    const std::size_t to = std::min(name.find('/', from), name.size());
    const std::string_view part = name.substr(from, to - from);
    from = to + 1;
    if (!part.empty() && part != ".") parts.emplace_back(part);
  }
  if (parts.size() > limits.max_depth) {
    refuse(name, fmt::format("a path of {} levels", parts.size()),
           fmt::format("at most {}", limits.max_depth));
  }
  return parts;
}

/// Notes an entry; entries of the same path are refused, also for case-insensitive systems.
void note(std::string_view name, const std::vector<std::string>& parts, bool is_folder,
          DistinctPaths& paths) {
  const auto clash = paths.add(fmt::format("{}", fmt::join(parts, "/")), is_folder);
  if (!clash) return;
  if (clash->is_equal) refuse(name, "the same path again", "each path once");
  refuse(name, fmt::format("also \"{}\"", printable(clash->earlier)),
         "names that differ in more than their case");
}

/// Skipped entries, which macOS adds by itself.
bool is_clutter(const std::vector<std::string>& parts) {
  return parts.empty() || parts.front() == "__MACOSX" || parts.back() == ".DS_Store";
}

class Unpacking {
 public:
  Unpacking(std::string_view bytes, const fs::path& folder, const UnpackLimits& limits)
      : folder_(folder),
        limits_(limits),
        packed_bytes_(static_cast<std::int64_t>(bytes.size())),
        archive_(archive_read_new(), archive_read_free) {
    if (!archive_) throw EnvironmentError("no memory for an archive's reader");
    archive_read_support_format_zip_seekable(archive_.get());
    archive_read_support_format_tar(archive_.get());
    archive_read_support_filter_gzip(archive_.get());
    if (archive_read_open_memory(archive_.get(), bytes.data(), bytes.size()) != ARCHIVE_OK) {
      fail("");
    }
    constexpr int kOneFilter = 2;  // and the source, which counts
    if (archive_filter_count(archive_.get()) > kOneFilter) {
      refuse("", "an archive that is compressed several times", "a zip, tar or tar.gz file");
    }
  }

  Unpacked run() {
    archive_entry* entry = nullptr;
    std::size_t entries = 0;
    while (true) {
      const int status = archive_read_next_header(archive_.get(), &entry);
      if (status == ARCHIVE_EOF) break;
      if (status != ARCHIVE_OK && status != ARCHIVE_WARN) fail("");
      if (++entries > limits_.max_entries) {
        refuse("", "more entries", fmt::format("at most {}", limits_.max_entries));
      }
      take(entry);
    }
    if (result_.files == 0) refuse("", "no file", "a zip, tar or tar.gz file with files");
    return result_;
  }

 private:
  [[noreturn]] void fail(std::string_view entry) {
    const char* message = archive_error_string(archive_.get());
    const std::string text = message == nullptr ? "what cannot be read" : message;
    if (archive_errno(archive_.get()) == ENOMEM) throw EnvironmentError("unpacking: " + text);
    refuse(entry, printable(text), "a whole zip, tar or tar.gz file");
  }

  void take(archive_entry* entry) {
    const char* text = archive_entry_pathname(entry);
    if (text == nullptr) refuse("", "an entry whose name is no text", kPlainName);
    const std::string name = text;
    const std::vector<std::string> parts = split_path(name, limits_);
    if (archive_entry_hardlink(entry) != nullptr || archive_entry_symlink(entry) != nullptr) {
      refuse(name, "a link", "files and folders");
    }
    const auto type = archive_entry_filetype(entry);
    if (type != AE_IFREG && type != AE_IFDIR) refuse(name, "a special file", "files and folders");
    if (archive_entry_is_encrypted(entry) != 0)
      refuse(name, "an encrypted entry", "one that is not");
    require_known_compression(name);
    // Skipped entries, and entries that should have no bytes, count too: reading past them is work.
    if (is_clutter(parts)) return pass_on(name, [](std::string_view) {});
    note(name, parts, type == AE_IFDIR, names_);
    if (names_.folders() > limits_.max_folders) {
      refuse(name, fmt::format("more than {} folders", limits_.max_folders), "fewer folders");
    }
    fs::path place = folder_;
    for (const std::string& part : parts) place /= part;
    fs::create_directories(type == AE_IFDIR ? place : place.parent_path());
    if (type == AE_IFDIR) return pass_on(name, [](std::string_view) {});
    write(name, place);
  }

  // Others may ask for gigabytes of memory before the first byte.
  void require_known_compression(const std::string& name) {
    if (archive_format(archive_.get()) != ARCHIVE_FORMAT_ZIP) return;
    const std::string format = archive_format_name(archive_.get());
    if (format.find("(deflation)") != std::string::npos) return;
    if (format.find("(uncompressed)") != std::string::npos) return;
    refuse(name, format, "zip entries that are stored or deflated");
  }

  template <typename Sink>
  void pass_on(const std::string& name, const Sink& sink) {
    std::int64_t file_bytes = 0;
    while (true) {
      const la_ssize_t count = archive_read_data(archive_.get(), block_.data(), block_.size());
      if (count < 0) fail(name);
      if (count == 0) return;
      file_bytes += count;
      result_.bytes += count;
      require_allowed(name, file_bytes);
      sink(std::string_view(block_.data(), static_cast<std::size_t>(count)));
    }
  }

  void write(const std::string& name, const fs::path& place) {
    errno = 0;
    std::ofstream file(place, std::ios::binary | std::ios::trunc);
    pass_on(name, [&](std::string_view bytes) {
      file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    });
    file.close();
    if (!file) throw_write_error(place, errno);
    ++result_.files;
  }

  void require_allowed(const std::string& name, std::int64_t file_bytes) const {
    if (file_bytes > limits_.max_file_bytes) {
      refuse(name, "a larger file", fmt::format("at most {} bytes", limits_.max_file_bytes));
    }
    if (result_.bytes > limits_.max_bytes) {
      refuse(name, "more bytes so far",
             fmt::format("at most {} in all files together", limits_.max_bytes));
    }
    constexpr std::int64_t kAlwaysFine = 4 << 20;
    if (result_.bytes > kAlwaysFine && result_.bytes / packed_bytes_ > limits_.max_ratio) {
      refuse(name, "a file that was packed too well",
             fmt::format("at most {} bytes for each byte of the archive", limits_.max_ratio));
    }
  }

  const fs::path& folder_;
  const UnpackLimits& limits_;
  std::int64_t packed_bytes_;
  ArchiveHandle archive_;
  DistinctPaths names_;
  Unpacked result_;
  std::vector<char> block_ = std::vector<char>(64 << 10);
};

/// Returns the number of bytes. `bytes_before` is that of the files before it.
std::int64_t copy_plain_file(const fs::path& from, const std::string& name, const fs::path& to,
                             const UnpackLimits& limits, std::int64_t bytes_before) {
  const ReadOnlyFile source(from);
  errno = 0;
  std::ofstream file(to, std::ios::binary | std::ios::trunc);
  std::vector<char> block(64 << 10);
  std::int64_t bytes = 0;
  while (const std::size_t count = source.read_at(bytes, block)) {
    bytes += static_cast<std::int64_t>(count);
    if (bytes > limits.max_file_bytes || bytes_before + bytes > limits.max_bytes) {
      refuse(name, "a larger file",
             fmt::format("at most {} bytes, and {} in all files together", limits.max_file_bytes,
                         limits.max_bytes));
    }
    file.write(block.data(), static_cast<std::streamsize>(count));
  }
  file.close();
  if (!file) throw_write_error(to, errno);
  return bytes;
}

}  // namespace

void to_json(nlohmann::json& value, const UnpackLimits& limits) {
  value = {{"max_entries", limits.max_entries},       {"max_file_bytes", limits.max_file_bytes},
           {"max_bytes", limits.max_bytes},           {"max_ratio", limits.max_ratio},
           {"max_path_bytes", limits.max_path_bytes}, {"max_depth", limits.max_depth},
           {"max_folders", limits.max_folders}};
}

void from_json(const nlohmann::json& value, UnpackLimits& limits) {
  value.at("max_entries").get_to(limits.max_entries);
  value.at("max_file_bytes").get_to(limits.max_file_bytes);
  value.at("max_bytes").get_to(limits.max_bytes);
  value.at("max_ratio").get_to(limits.max_ratio);
  value.at("max_path_bytes").get_to(limits.max_path_bytes);
  value.at("max_depth").get_to(limits.max_depth);
  value.at("max_folders").get_to(limits.max_folders);
}

Unpacked copy_unpacked(const fs::path& from, const fs::path& to, const UnpackLimits& limits) {
  Unpacked copied;
  DistinctPaths names;
  std::size_t entries = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(from)) {
    const std::string name = entry.path().lexically_relative(from).generic_string();
    const std::vector<std::string> parts = split_path(name, limits);
    const fs::file_type type = entry.symlink_status().type();
    const bool is_folder = type == fs::file_type::directory;
    if (!is_folder && type != fs::file_type::regular) {
      refuse(name, "no plain file", "files and folders");
    }
    note(name, parts, is_folder, names);
    if (++entries > limits.max_entries + limits.max_folders ||
        names.folders() > limits.max_folders) {
      refuse(name, "more files or folders",
             fmt::format("at most {} and {}", limits.max_entries, limits.max_folders));
    }
    if (is_folder) {
      fs::create_directories(to / name);
      continue;
    }
    fs::create_directories((to / name).parent_path());
    copied.bytes += copy_plain_file(entry.path(), name, to / name, limits, copied.bytes);
    ++copied.files;
  }
  if (copied.files == 0) refuse("", "no file", "a zip, tar or tar.gz file with files");
  return copied;
}

Unpacked unpack_archive(std::string_view bytes, const fs::path& folder,
                        const UnpackLimits& limits) {
  return Unpacking(bytes, folder, limits).run();
}

}  // namespace throng
