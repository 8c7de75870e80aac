// Files that are either complete or absent: everything is written beside its place and renamed.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace throng {

/// The whole file as bytes. Throws EnvironmentError naming the file when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes, syncs and renames, so that a reader sees the old file or the new one, never a part.
/// Creates the parent folder. Throws EnvironmentError.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Writes without syncing: for exchange between processes, in a folder that a crash may take along.
/// Throws EnvironmentError.
void write_temporary_file(const std::filesystem::path& path, std::string_view bytes);

/// Creates the folder and those around it, so that they are still there after a power failure.
/// Nothing if it exists. Throws EnvironmentError.
void make_folders(const std::filesystem::path& folder);

/// Gives the file a second name, or copies it where the file system has no hard links. Creates the
/// parent folder. Throws EnvironmentError naming both.
void link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to);

/// A file under construction, for what is too big to be held in memory. commit() gives it its name
/// (replacing an older file); otherwise the destructor removes it.
class StagedFile {
 public:
  /// Creates the parent folder and a temporary file beside `final_path`. Throws EnvironmentError.
  explicit StagedFile(std::filesystem::path final_path);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  const std::filesystem::path& path() const { return staging_; }  ///< until commit()
  /// Throws EnvironmentError when the disk is full.
  void write(std::string_view bytes);
  /// Gives what has been written to the system, so that others can read it at path().
  void flush();
  void commit();
  /// Likewise unless there is a file of that name: of several processes one succeeds.
  void commit_if_absent();

 private:
  std::filesystem::path final_;
  std::filesystem::path staging_;
  std::ofstream file_;
};

/// Removes what processes that died have left half-written in a folder (not below it): files and
/// folders under construction. Only while nobody writes there.
void remove_temporaries(const std::filesystem::path& folder);

/// Whether a path is a folder's or below it, as both are written: nothing is looked up.
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// A folder under construction. commit() renames it to its final place (replacing nothing: an
/// existing final folder is kept, since what is published is complete); otherwise the destructor
/// removes it.
class StagingFolder {
 public:
  /// Creates a folder at staging_path(final_path) (base/files/staging.h). Throws
  /// EnvironmentError.
  explicit StagingFolder(std::filesystem::path final_path);
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  const std::filesystem::path& path() const { return staging_; }
  void commit();
  /// Like commit(), but puts the new folder in the place of one that is there: a process that opens
  /// it sees the old folder or the new one.
  void commit_replacing();

 private:
  std::filesystem::path final_;
  std::filesystem::path staging_;
};

}  // namespace throng
