// Checksums of files and their parts, as object stores compare them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace throng::bucket {

/// Digests of a sequence of bytes.
struct Digest {
  std::string sha256_hex;
  std::string md5;  ///< 16 bytes, not hex
};

/// Digests of a file as a whole and of its parts.
struct FileDigest {
  Digest whole;
  std::vector<Digest> parts;  ///< of `part_size_bytes` each; the last part may be shorter
};

/// Reads the file once, in blocks. Throws EnvironmentError if it cannot be read.
FileDigest digest_of_file(const std::filesystem::path& path, std::int64_t part_size_bytes);

Digest compute_digest(std::string_view bytes);

/// The ETag that S3 gives an object of several parts: the MD5 of the parts' MD5s, "-", and the
/// number of parts.
std::string tag_of_parts(const std::vector<Digest>& parts);

}  // namespace throng::bucket
