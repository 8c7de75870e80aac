// The document that describes the API for users and their programs (OpenAPI 3.1).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "server/description/routes.h"

namespace throng::server {

/// A schema that types name.
struct NamedSchema {
  const char* name;
  ValueType type;
  const char* help = "";
};

/// The document of these routes and schemas.
nlohmann::ordered_json openapi_document(std::span<const Route> routes,
                                        const std::vector<NamedSchema>& schemas);

}  // namespace throng::server
