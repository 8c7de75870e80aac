#include "base/resource_exhaustion.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <new>
#include <system_error>

namespace throng {

namespace {

bool is_exhaustion(int error) {
  return error == EMFILE || error == ENFILE || error == ENOMEM || error == EAGAIN;
}

}  // namespace

void throw_environment_error(const std::string& message, int error) {
  std::string text = fmt::format("{}: {}", message, std::strerror(error));
  // The number tells a container's user from the owner of a mounted folder.
  if (error == EACCES || error == EPERM) text += fmt::format(" (user {})", ::geteuid());
  if (is_exhaustion(error)) throw ResourcesExhausted(text);
  throw EnvironmentError(text);
}

int likely_write_error(const std::filesystem::path& file) {
  constexpr std::uintmax_t kFullBytes = 64 << 10;
  std::error_code unknown;
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (::access(folder.c_str(), W_OK) != 0) return errno;
  const std::filesystem::space_info space = std::filesystem::space(folder, unknown);
  return !unknown && space.available < kFullBytes ? ENOSPC : EIO;
}

void throw_write_error(const std::filesystem::path& file, int error) {
  throw_environment_error(fmt::format("cannot write {}", file.string()),
                          error != 0 ? error : likely_write_error(file));
}

bool is_resource_exhaustion(const std::exception& error) {
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    return is_exhaustion(system->code().value());
  }
  return dynamic_cast<const ResourcesExhausted*>(&error) != nullptr ||
         dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
}

}  // namespace throng
