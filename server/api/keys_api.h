// Keys over HTTP, for administrators. The first key is made on the service's machine (`throng keys
// create`): until then everybody there may do everything, and nobody can lock the others out.
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
