// Folders whose content is written by processes that are not trusted, such as the workers of a
// service. A worker that was taken over could put a link to a secret where a result is expected;
// this process then must not follow it.
#pragma once

#include <filesystem>
#include <fstream>

namespace throng {

/// From now on, this process opens files below `area` only if they are regular files and no part of
/// their path below `area` is a link. read_file(), link_or_copy(), ReadOnlyFile and the hashes of
/// files (base/files/) obey. Safe to call from many threads.
void distrust_folders_in(const std::filesystem::path& area);

/// Opens a file for reading and returns its descriptor, or -1 with errno set. For a file below a
/// folder that is not trusted, errno is ELOOP if a part of the path is a link and EACCES if it is
/// not a regular file.
int open_for_reading(const std::filesystem::path& file);

/// A stream for reading a file, opened like open_for_reading(); not good() where that fails.
std::ifstream open_stream(const std::filesystem::path& file);

/// Opens or creates a file to append to, otherwise like open_for_reading().
int open_for_appending(const std::filesystem::path& file);

/// Whether a file or folder exists and no part of its path below a folder that is not trusted is a
/// link. For folders that are to be listed and files that a library opens by their names.
bool exists_without_links(const std::filesystem::path& path);

}  // namespace throng
