// The bytes around the files in an archive: headers of tar (POSIX ustar) and zip (store only,
// APPNOTE 6.3, zip64 where sizes ask for it). Owner 0, time 0: equal contents, equal bytes.
#pragma once

#include <cstdint>
#include <string>

namespace throng::jobs {

enum class ArchiveFormat : std::uint8_t { tar, zip };

/// A file in an archive.
struct ArchiveMember {
  std::string path;         ///< in the archive
  std::int64_t bytes = 0;   ///< of its content
  std::int64_t offset = 0;  ///< of its header in the archive
  std::string same_as;      ///< tar: the earlier member's path that this is a hard link to, or ""
  std::uint32_t crc32 = 0;  ///< zip
};

/// Two blocks of zeros end a tar file, which is made of blocks of 512 bytes.
inline constexpr std::int64_t kTarBlock = 512;
inline constexpr std::int64_t kTarEndBytes = 2 * kTarBlock;

std::string tar_header(const ArchiveMember& member);

/// Before a member's content.
std::string zip_header(const ArchiveMember& member);
/// The member's entry in the directory at the end.
std::string zip_entry(const ArchiveMember& member);
/// The end record of a zip file, after a directory with this number of entries at this offset.
std::string zip_end(std::uint64_t entries, std::int64_t directory_offset,
                    std::int64_t directory_bytes);

}  // namespace throng::jobs
