// A dataset as one tar or zip file that exists only while it is read: every byte's place follows
// from the manifest, so the length is known before the first byte, any part can be read on its own,
// and nothing is copied. (libarchive writes archives front to back only; reading them is tested
// with it.)
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "jobs/queue/dataset/archive_format.h"
#include "jobs/queue/dataset/manifest.h"
#include "jobs/queue/dataset/publication.h"
#include "jobs/queue/dataset/selection.h"

namespace throng::jobs {

/// An archive of the chosen files of the manifest and of the manifest itself, sorted by path, below
/// one folder: equal datasets give equal bytes. In a tar file the first of several files with equal
/// bytes is there and the others are hard links to it.
class Archive {
 public:
  /// `root` names the folder inside the archive: at most 100 characters of [A-Za-z0-9._-]. Throws
  /// EnvironmentError.
  Archive(std::filesystem::path dataset, const Manifest& manifest, const std::string& root,
          ArchiveFormat format = ArchiveFormat::tar, const Selection& selection = {});
  /// An archive of the files that the dataset's manifest lists.
  explicit Archive(const std::filesystem::path& dataset, const std::string& root,
                   ArchiveFormat format = ArchiveFormat::tar, const Selection& selection = {})
      : Archive(dataset, read_manifest(dataset), root, format, selection) {}

  std::int64_t size() const { return size_; }
  /// Whether it holds nothing but the manifest.
  bool is_empty() const { return files_.size() < 2; }

  /// Fills `buffer` with the bytes from `offset` on; returns how many: less than asked for only at
  /// the end. Throws EnvironmentError when a file is gone or no longer has its size.
  std::size_t read(std::int64_t offset, std::span<char> buffer) const;

 private:
  enum class PartKind : std::uint8_t { header, content, zeros, entry, end };
  /// A run of bytes up to where the next part begins.
  struct Part {
    std::int64_t offset;
    PartKind kind;
    std::uint32_t member;
  };

  void choose(const Manifest& manifest, const Selection& selection);
  void link_equal_files();
  void lay_out_tar();
  void lay_out_zip();
  void add_part(PartKind kind, std::size_t member, std::int64_t bytes);
  void read_part(const Part& part, std::int64_t from, std::span<char> buffer) const;

  std::filesystem::path dataset_;
  std::string root_;
  ArchiveFormat format_;
  std::vector<FileEntry> files_;        ///< sorted by path
  std::vector<ArchiveMember> members_;  ///< of the same files
  std::vector<Part> parts_;
  std::string end_;  ///< of a zip file
  std::int64_t size_ = 0;
};

/// A name as a file or folder name: lower-case letters, digits and '-', at most 60 of them.
std::string slug(const std::string& name);

}  // namespace throng::jobs
