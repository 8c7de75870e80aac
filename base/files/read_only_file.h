// A file open for random-access reading from several threads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace throng {

/// An open file; closed by the destructor.
class ReadOnlyFile {
 public:
  /// Throws EnvironmentError if the file cannot be opened.
  explicit ReadOnlyFile(const std::filesystem::path& path);
  ~ReadOnlyFile();
  ReadOnlyFile(const ReadOnlyFile&) = delete;
  ReadOnlyFile& operator=(const ReadOnlyFile&) = delete;

  std::int64_t size() const { return size_; }  ///< bytes, when the file was opened
  /// Modification time when the file was opened, Unix time.
  std::int64_t changed_ns() const { return changed_ns_; }

  /// Fills the buffer with the bytes from `offset` on. Returns their number, which is less than the
  /// size of the buffer only at the end of the file. Throws EnvironmentError.
  std::size_t read_at(std::int64_t offset, std::span<char> buffer) const;

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;
  std::int64_t changed_ns_ = 0;
};

}  // namespace throng
