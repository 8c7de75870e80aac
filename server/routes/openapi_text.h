// The description of the HTTP API, which a service sends as /openapi.json.
#pragma once

#include <string>

namespace throng::server {

/// All routes, their parameters, bodies and answers (OpenAPI 3.1), as JSON.
const std::string& openapi_text();

}  // namespace throng::server
