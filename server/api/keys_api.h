// Routes of keys, for administrators. The first key has to be created on the service's machine
// (`throng keys create`); without keys, every caller is an administrator, and no caller can lock
// out the others by a first key.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void create_key(Keys& keys, const httplib::Request& request, httplib::Response& response);
void list_keys(Keys& keys, httplib::Response& response);
void revoke_key(Keys& keys, const RevokedKeys& revoked, const Caller& caller,
                const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
