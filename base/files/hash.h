// SHA-256 and CRC-32 of bytes and files; hexadecimal and base 64 encoding.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace throng {

/// Encodes each byte as two lower-case hexadecimal digits.
std::string encode_hex(std::string_view bytes);
/// Encodes bytes in base 64 with padding (RFC 4648).
std::string encode_base64(std::string_view bytes);

std::string sha256_hex(std::string_view bytes);
/// Returns the SHA-256 in base 64 with padding, as in Content Security Policy level 3.
std::string sha256_base64(std::string_view bytes);

/// Returns the checksum of zip and gzip files (CRC-32 of ISO 3309).
std::uint32_t crc32(std::string_view bytes);

/// Both hashes of a file, which is read once, in blocks.
struct FileHashes {
  std::string sha256_hex;
  std::uint32_t crc32 = 0;
};
/// Throws EnvironmentError if the file cannot be read.
FileHashes hashes_of_file(const std::filesystem::path& path);

/// Reads the file in blocks. Throws EnvironmentError if it cannot be read.
std::string sha256_hex_of_file(const std::filesystem::path& path);

}  // namespace throng
