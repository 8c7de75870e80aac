// A dataset as one tar file that exists only while it is read: every byte's place follows from the
// manifest, so the length is known before the first byte, any part can be read on its own, and
// nothing is copied. (libarchive writes archives front to back only; reading them is tested with
// it.)
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace throng::jobs {

/// A ustar archive of the files in the manifest and the manifest itself, sorted by path, below one
/// folder; owner 0, time 0: equal datasets give equal bytes. Of files with equal bytes the first is
/// there and the others are hard links to it.
class Archive {
 public:
  /// Reads the dataset's manifest. `root` names the folder inside the archive: at most 100
  /// characters of [A-Za-z0-9._-]. Throws EnvironmentError.
  Archive(std::filesystem::path dataset, std::string root);

  std::int64_t size() const { return size_; }

  /// Fills `buffer` with the bytes from `offset` on; returns how many: less than asked for only at
  /// the end. Throws EnvironmentError when a file is gone or no longer has its size.
  std::size_t read(std::int64_t offset, std::span<char> buffer) const;

 private:
  struct Member {
    std::string path;  ///< relative to the dataset
    std::int64_t bytes = 0;
    std::int64_t offset = 0;  ///< of its header
    std::string same_as;      ///< path in the archive of the member that has its bytes, or ""
  };

  std::size_t read_member(const Member& member, std::int64_t offset, std::span<char> buffer) const;

  std::filesystem::path dataset_;
  std::string root_;
  std::vector<Member> members_;
  std::int64_t size_ = 0;
};

/// A name as a file or folder name: lower-case letters, digits and '-', at most 60 of them.
std::string slug(const std::string& name);

}  // namespace throng::jobs
