#include "base/files/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/staging.h"
#include "base/files/untrusted_folders.h"
#include "base/files/writable.h"
#include "base/resource_exhaustion.h"

namespace throng {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(std::string_view what, const fs::path& path, int error = errno) {
  throw_environment_error(fmt::format("cannot {} {}", what, path.string()), error);
}

void sync_path(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("open", path);
  const int result = ::fsync(descriptor);
  ::close(descriptor);
  if (result != 0) fail("sync", path);
}

// Files and the names of files are kept apart on a disk: each folder is synced, too.
void sync_tree(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() || (entry.is_directory() && !entry.is_symlink())) {
      sync_path(entry.path());
    }
  }
  sync_path(folder);
}

// A pipe, a terminal, /dev/null: a file that took its name would not reach who reads it.
bool is_stream(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path parent_folder(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

void make_folders(const fs::path& folder) {
  if (folder.empty() || fs::is_directory(folder)) return;
  make_folders(folder.parent_path());
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) {
    if (fs::exists(folder)) require_writable_folder(folder);  // says that it is a file
    require_writable_folder(parent_folder(folder));
    fail("create", folder, error.value());
  }
  sync_path(parent_folder(folder));
}

std::string read_file(const fs::path& path) {
  const int file = open_for_reading(path);
  if (file < 0) fail("read", path);
  constexpr std::size_t kBlockBytes = 1 << 16;
  std::string bytes;
  ssize_t count = 0;
  do {
    const std::size_t size = bytes.size();
    bytes.resize(size + kBlockBytes);
    count = ::read(file, bytes.data() + size, kBlockBytes);
    const bool is_interrupted = count < 0 && errno == EINTR;
    bytes.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (is_interrupted) count = 1;
  } while (count > 0);
  const int error = errno;
  ::close(file);
  if (count < 0) fail("read", path, error);
  return bytes;
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  StagedFile file(path);
  file.write(bytes);
  file.commit();
}

void write_temporary_file(const fs::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail("write", path);
}

void link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::symlink_status(from, error).type() != fs::file_type::not_found &&
      !exists_without_links(from)) {
    throw InputError({from.string(), "", "a link", "a regular file, without links on its path"});
  }
  fs::create_hard_link(from, to, error);
  if (error == std::errc::no_such_file_or_directory) {
    fs::create_directories(parent_folder(to), error);
    if (!error) fs::create_hard_link(from, to, error);
  }
  if (error) copy_new_file(from, to);
}

void copy_new_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, error);
  if (!error) return;
  // The standard library copies with sendfile(), whose error it replaces.
  throw_environment_error(fmt::format("cannot copy {} to {}", from.string(), to.string()),
                          error == std::errc::io_error ? likely_write_error(to) : error.value());
}

bool is_within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

StagedFile::StagedFile(fs::path final_path)
    : final_(std::move(final_path)), staging_(is_stream(final_) ? final_ : staging_path(final_)) {
  make_folders(parent_folder(final_));
  errno = 0;
  file_.open(staging_, std::ios::binary);
  if (file_) return;
  const int reason = errno;
  require_writable_folder(parent_folder(final_));
  fail("write", staging_, reason);
}

StagedFile::~StagedFile() {
  file_.close();
  if (staging_ == final_) return;
  std::error_code ignored;
  fs::remove(staging_, ignored);
}

void StagedFile::write(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file_) fail("write", staging_);
}

void StagedFile::flush() {
  file_.flush();
  if (!file_) fail("write", staging_);
}

void StagedFile::commit() {
  file_.close();
  if (!file_) fail("write", staging_);
  if (staging_ == final_) return;
  sync_path(staging_);
  const std::error_code error = publish_staged(staging_, final_);
  if (error) fail("write", final_, error.value());
  sync_path(parent_folder(final_));
}

void StagedFile::commit_if_absent() {
  file_.close();
  if (!file_) fail("write", staging_);
  sync_path(staging_);
  const std::error_code error = link_staged(staging_, final_);
  if (error && error != std::errc::file_exists) fail("write", final_, error.value());
  sync_path(parent_folder(final_));
}

StagingFolder::StagingFolder(fs::path final_path)
    : final_(std::move(final_path)), staging_(staging_path(final_)) {
  make_folders(parent_folder(final_));
  std::error_code error;
  fs::create_directory(staging_, error);
  if (!error) return;
  require_writable_folder(parent_folder(final_));
  fail("create", staging_, error.value());
}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void StagingFolder::commit_replacing() {
  if (!fs::exists(final_)) return commit();
  sync_tree(staging_);
  // The old folder changes places with the new one, and goes with this object.
  if (::renameat2(AT_FDCWD, staging_.c_str(), AT_FDCWD, final_.c_str(), RENAME_EXCHANGE) != 0) {
    fail("replace", final_);
  }
  sync_path(parent_folder(final_));
}

void StagingFolder::commit() {
  sync_tree(staging_);
  const std::error_code error = publish_staged(staging_, final_);
  if (error && !fs::exists(final_)) {
    throw EnvironmentError(fmt::format("cannot publish {}: {}", final_.string(), error.message()));
  }
  sync_path(parent_folder(final_));
}

void remove_temporaries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename().string().find(".tmp.") != std::string::npos) {
      leftovers.push_back(entry.path());
    }
  }
  for (const fs::path& leftover : leftovers) {
    if (fs::remove_all(leftover, error); error) {
      throw EnvironmentError(
          fmt::format("cannot remove {}: {}", leftover.string(), error.message()));
    }
  }
}

}  // namespace throng
