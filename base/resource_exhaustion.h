// Errors that say that the machine lacks something for the moment: open files, processes, memory.
// Nobody's job is wrong, and no attempt counts.
#pragma once

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

}  // namespace throng
