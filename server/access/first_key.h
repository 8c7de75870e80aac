// The first key of a service in a container, which nobody has made beforehand.
#pragma once

#include <string>

#include "server/access/keys.h"

namespace throng::server {

/// Name of the environment variable that names a file with the administrator's key.
inline constexpr const char* kAdminKeyFileVariable = "THRONG_ADMIN_KEY_FILE";

/// Whether this process runs in a container: $THRONG_CONTAINER is set, as our image does, or there
/// is the mark of Docker or Podman.
bool is_in_container();

/// Makes the administrator's key where there is none yet: the one in $THRONG_ADMIN_KEY_FILE if that
/// is set, else, in a container, a random one. Returns what to tell the person who started the
/// service: the key, shown only now, and the address to use it at; "" where nothing is to be said.
/// Throws InputError if the file cannot be read or holds no key.
std::string make_first_key(Keys& keys, int port);

}  // namespace throng::server
