// SHA-256 of bytes and files, as lower-case hex or in base 64, and CRC-32.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace throng {

/// Two lower-case hexadecimal digits for each byte.
std::string encode_hex(std::string_view bytes);
/// Base 64 with padding (RFC 4648).
std::string encode_base64(std::string_view bytes);

std::string sha256_hex(std::string_view bytes);
/// In base 64 with padding, as browsers compare scripts (Content Security Policy level 3).
std::string sha256_base64(std::string_view bytes);

/// The checksum of zip files and gzip (CRC-32 of ISO 3309).
std::uint32_t crc32(std::string_view bytes);

/// Both of a file, which is read once, in blocks. Throws EnvironmentError when it cannot be read.
struct FileHashes {
  std::string sha256_hex;
  std::uint32_t crc32 = 0;
};
FileHashes hashes_of_file(const std::filesystem::path& path);

/// Reads the file in blocks. Throws EnvironmentError when it cannot be read.
std::string sha256_hex_of_file(const std::filesystem::path& path);

}  // namespace throng
