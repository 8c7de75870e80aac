// Checksums of parts of files, as object stores compare them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace throng::bucket {

/// Digests of some bytes, both from one pass over them.
struct Digest {
  std::string sha256_hex;
  std::string md5;  ///< 16 bytes
};

/// Digests of a file as a whole and of its parts, read once in blocks.
struct FileDigest {
  Digest whole;
  std::vector<Digest> parts;  ///< of `part_size_bytes` each, the last one of what is left
};

/// Throws EnvironmentError when the file cannot be read.
FileDigest digest_of_file(const std::filesystem::path& path, std::int64_t part_size_bytes);

Digest compute_digest(std::string_view bytes);

/// The tag that S3 gives an object of several parts: the MD5 of the parts' MD5, and their number.
std::string tag_of_parts(const std::vector<Digest>& parts);

}  // namespace throng::bucket
