#include "server/access/first_key.h"

#include <fmt/core.h>

#include <cstdlib>

#include "base/error.h"
#include "base/files/files.h"

namespace throng::server {

namespace {

constexpr const char* kName = "administrator";

/// The key in the file, without the line's end.
std::string key_in(const std::string& path) {
  std::string key = read_file(path);
  while (!key.empty() && (key.back() == '\n' || key.back() == '\r')) key.pop_back();
  return key;
}

}  // namespace

bool is_in_container() {
  const char* said = std::getenv("THRONG_CONTAINER");
  return said != nullptr && *said != '\0';
}

std::string make_first_key(Keys& keys, int port) {
  if (keys.are_needed()) return "";
  if (const char* file = std::getenv(kAdminKeyFileVariable); file != nullptr && *file != '\0') {
    const std::string key = key_in(file);
    if (!is_own_key(key)) {
      throw InputError(Problem{
          file, "", fmt::format("a key of {} characters", key.size()),
          "32 to 128 letters, digits or -._~+/= on one line, which nobody can guess, such as "
          "`openssl rand -hex 32` prints"});
    }
    keys.add(kName, Scope::admin, key);
    return "";
  }
  if (!is_in_container()) return "";
  const std::string key = keys.create(kName, Scope::admin);
  return fmt::format(
      "throng: the first start: this is the administrator's key. It is not shown again.\n\n    "
      "{}\n\nSign in with it at "
      "http://localhost:{} (the port to which `docker run -p` leads), or\n    export "
      "THRONG_URL=http://localhost:{} "
      "THRONG_KEY={}\n",
      key, port, port, key);
}

}  // namespace throng::server
