#include "jobs/queue/confine/credentials.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

#include "base/resource_exhaustion.h"

namespace throng::jobs {

namespace {

constexpr std::string_view kCredentialPrefix = "AWS_";

}  // namespace

bool is_secret_variable(std::string_view name) {
  constexpr std::array<std::string_view, 5> kParts = {"SECRET", "TOKEN", "PASSWORD", "PASSWD",
                                                      "API_KEY"};
  return name.starts_with(kCredentialPrefix) ||
         std::any_of(kParts.begin(), kParts.end(),
                     [&](std::string_view part) { return name.find(part) != name.npos; });
}

CredentialVariables credential_variables() {
  CredentialVariables variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::size_t end = text.find('=');
    if (!text.starts_with(kCredentialPrefix) || end == std::string_view::npos) continue;
    variables.emplace_back(text.substr(0, end), text.substr(end + 1));
  }
  return variables;
}

void hide_environment() {
  // Never destroyed: the C library takes pointers into them, and others ask it at exit().
  static auto& texts =
      *new std::vector<std::unique_ptr<char[]>>;  // NOLINT(modernize-avoid-c-arrays)
  static auto& entries = *new std::vector<char*>;
  entries.clear();
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::size_t size = std::strlen(*entry) + 1;
    auto& text =
        texts.emplace_back(std::make_unique<char[]>(size));  // NOLINT(modernize-avoid-c-arrays)
    std::memcpy(text.get(), *entry, size);
    ::explicit_bzero(*entry, size);
    entries.push_back(text.get());
  }
  entries.push_back(nullptr);
  environ = entries.data();
}

int descriptor_of_credentials(const CredentialVariables& variables) {
  std::string text;
  for (const auto& [name, value] : variables) text += name + "=" + value + '\0';
  const int memory = ::memfd_create("credentials", MFD_CLOEXEC);
  if (memory < 0) throw_environment_error("cannot hand on credentials", errno);
  if (::write(memory, text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
      ::lseek(memory, 0, SEEK_SET) != 0) {
    const int error = errno;
    ::close(memory);
    throw_environment_error("cannot hand on credentials", error);
  }
  return memory;
}

void take_credentials() {
  // A worker on a node, and one that a person starts, has no file there.
  struct stat status {};
  if (::fstat(STDIN_FILENO, &status) != 0 || !S_ISREG(status.st_mode)) return;
  std::string text;
  std::array<char, 4096> block{};
  for (ssize_t count = 0; (count = ::read(STDIN_FILENO, block.data(), block.size())) > 0;) {
    text.append(block.data(), static_cast<std::size_t>(count));
  }
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\0', start), text.size());
    const std::string entry = text.substr(start, end - start);
    const std::size_t equals = entry.find('=');
    if (equals != std::string::npos && entry.starts_with(kCredentialPrefix)) {
      ::setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
    }
    start = end + 1;
  }
}

}  // namespace throng::jobs
