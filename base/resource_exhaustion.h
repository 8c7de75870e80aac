// Errors that say that the machine lacks something for the moment: open files, processes, memory.
// Nobody's job is wrong, and no attempt counts.
#pragma once

#include <filesystem>

#include <exception>
#include <string>

#include "base/error.h"

namespace throng {

class ResourcesExhausted : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

/// Throws ResourcesExhausted if the errno says so, else EnvironmentError; the message gets the
/// errno's text.
[[noreturn]] void throw_environment_error(const std::string& message, int error);

/// Whether this is ResourcesExhausted, std::bad_alloc, or an error of threads or files with such an
/// errno.
bool is_resource_exhaustion(const std::exception& error);

/// Throws EnvironmentError("cannot write FILE: No space left on device"). `error` is an errno, or 0
/// where a library keeps it to itself: then a disk without free space is the reason.
[[noreturn]] void throw_write_error(const std::filesystem::path& file, int error);

}  // namespace throng
