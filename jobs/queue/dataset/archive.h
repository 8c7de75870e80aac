// A dataset as a virtual tar or zip file: the manifest determines the offset of every byte, so the
// length is known before the first byte, any range can be read on its own, and nothing is copied.
// (libarchive can write archives only from front to back; the tests read ours with it.)
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

/// An archive of the selected files and the manifest, sorted by path, below one folder. Equal
/// datasets give equal bytes. In a tar file, files with equal bytes are hard links to the first
/// one.
class Archive {
 public:
  /// `root` names the folder inside the archive: at most 100 characters of [A-Za-z0-9._-]. Throws
  /// EnvironmentError, also for names that Linux, macOS or Windows does not allow or tell apart.
  Archive(std::filesystem::path dataset, const Manifest& manifest, const std::string& root,
          ArchiveFormat format = ArchiveFormat::tar, const Selection& selection = {});
  /// An archive of the files that the dataset's manifest lists.
  explicit Archive(const std::filesystem::path& dataset, const std::string& root,
                   ArchiveFormat format = ArchiveFormat::tar, const Selection& selection = {})
      : Archive(dataset, read_manifest(dataset), root, format, selection) {}

  std::int64_t size() const { return size_; }
  /// Whether the archive contains only the manifest.
  bool is_empty() const { return files_.size() < 2; }

  /// Fills `buffer` with the bytes from `offset` on and returns their number, which is less than
  /// the buffer's size only at the end. Throws EnvironmentError if a file is missing or has another
  /// size than in the manifest.
  std::size_t read(std::int64_t offset, std::span<char> buffer) const;

 private:
  enum class PartKind : std::uint8_t { header, content, zeros, entry, end };
  /// A range of bytes that ends at the offset of the next part.
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
  std::vector<ArchiveMember> members_;  ///< one per file, in the order of files_
  std::vector<Part> parts_;
  std::string end_;  ///< end record of a zip file
  std::int64_t size_ = 0;
};

}  // namespace throng::jobs
