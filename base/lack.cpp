#include "base/lack.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>

namespace throng {

namespace {

bool is_lack(int error) {
  return error == EMFILE || error == ENFILE || error == ENOMEM || error == EAGAIN;
}

}  // namespace

void throw_environment_error(const std::string& message, int error) {
  const std::string text = fmt::format("{}: {}", message, std::strerror(error));
  if (is_lack(error)) throw LacksResources(text);
  throw EnvironmentError(text);
}

bool says_lack_of_resources(const std::exception& error) {
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    return is_lack(system->code().value());
  }
  return dynamic_cast<const LacksResources*>(&error) != nullptr ||
         dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
}

}  // namespace throng
