// Reader for traces named on the command line, which may be damaged.
#pragma once

#include <filesystem>

#include "world/trace.h"

namespace throng::cli {

/// Calls world::read_trace() after a child process has read the file, because the HDF5 library
/// crashes on some damaged files. This doubles the time. Throws InputError if there is no such file
/// or the child crashes or does not end, and the exceptions of read_trace().
world::Trace read_trace_file(const std::filesystem::path& path);

}  // namespace throng::cli
