// Routes of keys, for administrators. The first key has to be created on the service's machine
// (`throng keys create`); without keys, every caller is an administrator, and no caller can lock
// out the others by a first key.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void create_key(const RequestContext& context, const httplib::Request& request,
                httplib::Response& response);
void list_keys(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
void revoke_key(const RequestContext& context, const httplib::Request& request,
                httplib::Response& response);

}  // namespace throng::server
