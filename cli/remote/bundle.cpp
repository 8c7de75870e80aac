#include "cli/remote/bundle.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/words.h"

namespace throng::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxBundleBytes = 64 << 20;

std::string bundle_name(const fs::path& from) {
  fs::path name = fs::absolute(from).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();
  std::string word = lower_case(name.filename().string());
  if (!fs::is_directory(from)) word.resize(std::min(word.find('.'), word.size()));
  for (char& c : word) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return word;
}

/// Regular files below a folder, as paths in it, in order.
std::vector<std::string> list_bundle_files(const fs::path& folder) {
  std::vector<std::string> names;
  for (auto at = fs::recursive_directory_iterator(folder); at != fs::end(at); ++at) {
    if (at->path().filename().string().starts_with('.')) {
      if (at->is_directory()) at.disable_recursion_pending();
      continue;
    }
    if (at->is_regular_file() && !at->is_symlink()) {
      names.push_back(at->path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

[[noreturn]] void refuse_size(const fs::path& from) {
  throw InputError(Problem{from.string(), "", "a larger bundle",
                           fmt::format("at most {} bytes", kMaxBundleBytes)});
}

std::string pack_tar(const fs::path& folder) {
  const std::unique_ptr<archive, int (*)(archive*)> writer(archive_write_new(), archive_write_free);
  archive_write_set_format_pax_restricted(writer.get());
  archive_write_set_bytes_in_last_block(writer.get(), 1);
  std::string bytes;
  const auto append = [](archive*, void* to, const void* data, std::size_t size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), size);
    return static_cast<la_ssize_t>(size);
  };
  archive_write_open(writer.get(), &bytes, nullptr, append, nullptr);
  for (const std::string& name : list_bundle_files(folder)) {
    if (fs::file_size(folder / name) + bytes.size() > kMaxBundleBytes) refuse_size(folder);
    const std::string content = read_file(folder / name);
    const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                         archive_entry_free);
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    constexpr int kMode = 0644;
    archive_entry_set_perm(entry.get(), kMode);
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
    if (archive_write_header(writer.get(), entry.get()) < ARCHIVE_WARN ||
        archive_write_data(writer.get(), content.data(), content.size()) < 0) {
      throw EnvironmentError(fmt::format("cannot pack {}: {}", (folder / name).string(),
                                         archive_error_string(writer.get())));
    }
  }
  archive_write_close(writer.get());
  return bytes;
}

}  // namespace

Bundle read_bundle(const fs::path& from) {
  if (fs::is_directory(from)) return {bundle_name(from), pack_tar(from)};
  if (!fs::is_regular_file(from)) {
    throw InputError(Problem{from.string(), "", "no file or folder",
                             "a folder of scenarios, or a zip or tar file"});
  }
  if (fs::file_size(from) > kMaxBundleBytes) refuse_size(from);
  return {bundle_name(from), read_file(from)};
}

}  // namespace throng::cli
