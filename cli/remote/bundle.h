// Scenarios as they are sent to a server: one file of many.
#pragma once

#include <filesystem>
#include <string>

namespace throng::cli {

struct Bundle {
  std::string name;  ///< of the folder or file, as a server takes it: [a-z0-9_]
  std::string bytes;
};

/// A zip, tar or tar.gz file as it is; a folder's files as a tar file whose bytes follow from them
/// alone (names in order, no times, no owners). Hidden files and links stay out. Throws InputError
/// when there is no such file or folder, or when it has more than 64 MiB, which servers refuse.
Bundle read_bundle(const std::filesystem::path& from);

}  // namespace throng::cli
