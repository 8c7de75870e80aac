// The administrator's key at the start of a service: from a file, or made in a container.
#pragma once

#include <string>

#include "server/access/keys.h"

namespace throng::server {

/// Environment variable with the path of a file that holds the administrator's key.
inline constexpr const char* kAdminKeyFileVariable = "THRONG_ADMIN_KEY_FILE";

/// Whether this process runs in a container: $THRONG_CONTAINER is set, as in throng's image, or a
/// marker file of Docker or Podman exists.
bool is_in_container();

/// Adds the administrator's key: the one in $THRONG_ADMIN_KEY_FILE if that is set, else, with
/// `may_make_one` in a container without keys, a random one. Returns a message for the operator
/// with the random key, which is not shown again, and the service's address; "" if no random key
/// was made. Throws InputError if the file is missing, readable by every user or holds no valid
/// key, or a key that was revoked.
std::string make_first_key(Keys& keys, int port, bool may_make_one);

}  // namespace throng::server
