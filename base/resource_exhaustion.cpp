#include "base/resource_exhaustion.h"

#include <fmt/core.h>

#include <cerrno>
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
  const std::string text = fmt::format("{}: {}", message, std::strerror(error));
  if (is_exhaustion(error)) throw ResourcesExhausted(text);
  throw EnvironmentError(text);
}

bool is_resource_exhaustion(const std::exception& error) {
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    return is_exhaustion(system->code().value());
  }
  return dynamic_cast<const ResourcesExhausted*>(&error) != nullptr ||
         dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
}

}  // namespace throng
