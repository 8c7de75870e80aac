// All operations of the API, and the document that describes them.
#pragma once

#include <span>

#include "server/description/routes.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// All operations of the API, resource by resource.
std::span<const Route> routes();

/// GET /openapi.json: openapi_text().
void send_openapi(httplib::Response& response);

}  // namespace throng::server
