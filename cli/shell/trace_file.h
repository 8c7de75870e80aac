// Traces that a command line names: files that may be damaged.
#pragma once

#include <filesystem>

#include "world/trace.h"

namespace throng::cli {

/// world::read_trace() of a file that may be damaged anywhere. The HDF5 library crashes on some
/// files whose internal addresses or sizes are wrong, so a child process reads the file first.
/// Throws InputError where there is no such file or the child crashed or did not end, and what
/// read_trace() throws. Reading takes twice as long.
world::Trace read_trace_file(const std::filesystem::path& path);

}  // namespace throng::cli
