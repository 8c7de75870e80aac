// Errors of a machine that temporarily lacks open files, processes or memory. They are not the
// fault of a job, and the attempt does not count.
#pragma once

#include <filesystem>

#include <exception>
#include <string>

#include "base/error.h"

namespace throng {

/// A temporary lack of resources.
class ResourcesExhausted : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

/// Throws ResourcesExhausted if the errno `error` means a lack of resources, else EnvironmentError.
/// The text of the errno is appended to the message.
[[noreturn]] void throw_environment_error(const std::string& message, int error);

/// Whether an error is ResourcesExhausted, std::bad_alloc, or a std::system_error with such an
/// errno.
bool is_resource_exhaustion(const std::exception& error);

/// The errno of a failed write that a library reports as failed, or as an I/O error, only: that of
/// missing write access, of a full disk or, if neither is found, EIO.
int likely_write_error(const std::filesystem::path& file);

/// Throws EnvironmentError("cannot write FILE: No space left on device"). `error` is an errno, or 0
/// for likely_write_error().
[[noreturn]] void throw_write_error(const std::filesystem::path& file, int error);

}  // namespace throng
