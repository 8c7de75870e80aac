// Files that are either complete or absent: they are written under a temporary name and renamed.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace throng {

/// Reads a whole file. Throws EnvironmentError with the file's name if it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes a file, syncs and renames it, so that readers see the old or the new file but never a
/// part. Creates the parent folder. Throws EnvironmentError.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Writes a file without sync and renaming: for exchange between processes in a temporary folder.
/// Throws EnvironmentError.
void write_temporary_file(const std::filesystem::path& path, std::string_view bytes);

/// Creates a folder and its parents and syncs them, so that they survive a power failure. Does
/// nothing if the folder exists. Throws EnvironmentError.
void make_folders(const std::filesystem::path& folder);

/// Creates a hard link, or a copy if the file system has no hard links. Creates the parent folder.
/// Throws EnvironmentError with both names.
void link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to);

/// Copies a file to a name that no file has. Throws EnvironmentError with both names.
void copy_new_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// A file under construction, for content that is too large for memory. commit() gives the file its
/// final name and replaces an older file; without it, the destructor removes the file.
class StagedFile {
 public:
  /// Creates the parent folder and a temporary file beside `final_path`. Throws EnvironmentError.
  explicit StagedFile(std::filesystem::path final_path);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  const std::filesystem::path& path() const { return staging_; }  ///< valid until commit()
  /// Throws EnvironmentError if the file cannot be written, e.g. on a full disk.
  void write(std::string_view bytes);
  /// Flushes buffers to the operating system, so that others can read the bytes at path(). Throws
  /// EnvironmentError.
  void flush();
  /// Syncs the file and renames it. Throws EnvironmentError.
  void commit();
  /// Syncs the file and links it to its final name unless that exists: of several processes, one
  /// succeeds. Throws EnvironmentError.
  void commit_if_absent();

 private:
  std::filesystem::path final_;
  std::filesystem::path staging_;
  std::ofstream file_;
};

/// Removes unfinished files and folders of dead processes directly in `folder`. No process may
/// write there at the same time. Throws EnvironmentError.
void remove_temporaries(const std::filesystem::path& folder);

/// Whether `path` equals `folder` or begins with it, component by component; ignores links and
/// "..".
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// A folder under construction. commit() renames it to its final name unless that exists: published
/// folders are complete and are kept. Otherwise the destructor removes it.
class StagingFolder {
 public:
  /// Creates a folder at staging_path(final_path) (base/files/staging.h). Throws EnvironmentError.
  explicit StagingFolder(std::filesystem::path final_path);
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  const std::filesystem::path& path() const { return staging_; }
  /// Syncs all files and renames the folder. Throws EnvironmentError.
  void commit();
  /// Like commit(), but replaces an existing folder atomically: other processes see the old or the
  /// new one.
  void commit_replacing();

 private:
  std::filesystem::path final_;
  std::filesystem::path staging_;
};

}  // namespace throng
