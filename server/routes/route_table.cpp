#include "server/routes/route_table.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "server/http/http.h"
#include "server/routes/openapi_text.h"
#include "server/routes/resources.h"

namespace throng::server {

Route begins_work(Route route) {
  route.begins_work = true;
  return route;
}

Route unaudited(Route route) {
  route.is_audited = false;
  return route;
}

Route with_scripts(Route route) {
  route.has_scripts = true;
  return route;
}

std::vector<Route> tagged(const char* tag, std::vector<Route> routes) {
  for (Route& route : routes) route.says.tag = tag;
  return routes;
}

std::span<const Route> routes() {
  static const std::vector<Route> all = [] {
    std::vector<Route> table;
    for (const auto& resource :
         {&job_routes, &result_routes, &calibration_routes, &study_routes, &live_routes,
          &catalog_routes, &key_routes, &webhook_routes, &service_routes}) {
      std::ranges::move(resource(), std::back_inserter(table));
    }
    return table;
  }();
  return all;
}

const std::string& openapi_text() {
  static const std::string text = [] {
    std::vector<NamedSchema> schemas;
    for (const auto& resource :
         {&job_schemas, &result_schemas, &calibration_schemas, &study_schemas, &live_schemas,
          &catalog_schemas, &access_schemas}) {
      std::ranges::move(resource(), std::back_inserter(schemas));
    }
    return openapi_document(routes(), schemas).dump(1) + "\n";
  }();
  return text;
}

void send_openapi(httplib::Response& response) {
  response.set_content(openapi_text(), "application/json");
}

}  // namespace throng::server
