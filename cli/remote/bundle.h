// Bundles of scenarios for upload to a server.
#pragma once

#include <filesystem>
#include <string>

namespace throng::cli {

/// An archive and its name.
struct Bundle {
  std::string name;  ///< from the name of the folder or file, converted to [a-z0-9_]
  std::string bytes;
};

/// Reads a zip, tar or tar.gz file, or packs the files of a folder as a tar file whose bytes depend
/// on their names and contents only (sorted, no times, no owners). Leaves out hidden files and
/// links. Throws InputError if there is no such file or folder, or if the bundle exceeds 64 MiB,
/// the limit of servers.
Bundle read_bundle(const std::filesystem::path& from);

}  // namespace throng::cli
