// Headers of archives: tar (POSIX ustar) and zip (stored, PKWARE APPNOTE 6.3, zip64 where sizes
// require it). Owner and time are 0, so that equal contents give equal bytes.
#pragma once

#include <cstdint>
#include <string>

namespace throng::jobs {

enum class ArchiveFormat : std::uint8_t { tar, zip };

/// A file in an archive.
struct ArchiveMember {
  std::string path;         ///< in the archive
  std::int64_t bytes = 0;   ///< size of its content
  std::int64_t offset = 0;  ///< offset of its header in the archive
  std::string same_as;      ///< tar: target of this hard link, an earlier member; "" for a file
  std::uint32_t crc32 = 0;  ///< zip only
};

/// A tar file consists of blocks of 512 bytes and ends with two blocks of zeros.
inline constexpr std::int64_t kTarBlock = 512;
inline constexpr std::int64_t kTarEndBytes = 2 * kTarBlock;

/// The header of a member, in whole blocks.
std::string tar_header(const ArchiveMember& member);

/// The local file header, which precedes a member's content.
std::string zip_header(const ArchiveMember& member);
/// The member's entry in the central directory.
std::string zip_entry(const ArchiveMember& member);
/// The end record, which follows a central directory with this number of entries at this offset.
std::string zip_end(std::uint64_t entries, std::int64_t directory_offset,
                    std::int64_t directory_bytes);

}  // namespace throng::jobs
