#include "server/access/first_key.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <cstdlib>
#include <optional>

#include "base/error.h"
#include "base/files/files.h"

namespace throng::server {

namespace {

constexpr const char* kName = "administrator";

/// The key in the file, without the line's end.
std::string key_in(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw InputError(Problem{kAdminKeyFileVariable, "",
                             path.empty() ? "an empty path" : path + ", which is no file",
                             "the path of a file with a key, or no such variable"});
  }
  if ((status.st_mode & S_IROTH) != 0) {
    throw InputError(Problem{path, "",
                             fmt::format("mode {:04o}: every user of this machine can read the key",
                                         status.st_mode & 07777U),
                             "a file that only the service's user can read (chmod 400)"});
  }
  std::string key = read_file(path);
  while (!key.empty() && (key.back() == '\n' || key.back() == '\r')) key.pop_back();
  if (!is_own_key(key)) {
    throw InputError(
        Problem{path, "", fmt::format("a key of {} characters", key.size()),
                "32 to 128 letters, digits or -._~+/= on one line, which nobody can guess, such as "
                "`openssl rand -hex 32` prints"});
  }
  return key;
}

/// Makes the key in the file valid, whatever others there are.
void take_key(Keys& keys, const std::string& file) {
  const std::string key = key_in(file);
  const std::optional<KeyRow> known = keys.row_of(key);
  if (known && !keys.caller_of(key)) {
    const char* why = known->revoked_ms != 0 ? "was revoked" : "has expired";
    throw InputError(
        Problem{file, "", fmt::format("the key {}, which {}", known->id, why), "another key"});
  }
  if (!known) keys.add(kName, Scope::admin, key);
}

}  // namespace

bool is_in_container() {
  const char* said = std::getenv("THRONG_CONTAINER");
  return said != nullptr && *said != '\0';
}

std::string make_first_key(Keys& keys, int port, bool may_make_one) {
  if (const char* file = std::getenv(kAdminKeyFileVariable); file != nullptr) {
    take_key(keys, file);
    return "";
  }
  if (!may_make_one || keys.are_needed() || !is_in_container()) return "";
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
