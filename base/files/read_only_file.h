// A file that is open for reading at any place, by any number of threads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace throng {

class ReadOnlyFile {
 public:
  /// Throws EnvironmentError when it cannot be opened.
  explicit ReadOnlyFile(const std::filesystem::path& path);
  ~ReadOnlyFile();
  ReadOnlyFile(const ReadOnlyFile&) = delete;
  ReadOnlyFile& operator=(const ReadOnlyFile&) = delete;

  std::int64_t size() const { return size_; }              ///< when it was opened
  std::int64_t changed_ns() const { return changed_ns_; }  ///< Unix time of its last change then

  /// Fills the buffer with the bytes from `offset` on; returns how many there were: fewer than
  /// asked for only at the end of the file. Throws EnvironmentError.
  std::size_t read_at(std::int64_t offset, std::span<char> buffer) const;

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;
  std::int64_t changed_ns_ = 0;
};

}  // namespace throng
