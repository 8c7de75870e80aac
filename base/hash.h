// SHA-256 of bytes and files, as lower-case hex.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace throng {

std::string sha256_hex(std::string_view bytes);

/// Reads the file in blocks. Throws EnvironmentError when it cannot be read.
std::string sha256_hex_of_file(const std::filesystem::path& path);

}  // namespace throng
