// The routes of each resource: how they are asked for, what they say, who answers.
#pragma once

#include <utility>
#include <vector>

#include "server/api/handler.h"
#include "server/description/openapi.h"
#include "server/description/routes.h"

namespace throng::server {

std::vector<Route> job_routes();
std::vector<Route> result_routes();
std::vector<Route> calibration_routes();
std::vector<Route> study_routes();
std::vector<Route> live_routes();
std::vector<Route> catalog_routes();
std::vector<Route> key_routes();
std::vector<Route> webhook_routes();
std::vector<Route> service_routes();

/// Schemas of the answers.
std::vector<NamedSchema> job_schemas();
std::vector<NamedSchema> result_schemas();
std::vector<NamedSchema> calibration_schemas();
std::vector<NamedSchema> study_schemas();
std::vector<NamedSchema> live_schemas();
std::vector<NamedSchema> catalog_schemas();
std::vector<NamedSchema> access_schemas();

/// Something that is queued; `more` members than all of them have.
ValueType row(ValueType state, ValueType progress, const std::vector<Member>& more);
/// Paths below which there is more about a value.
ValueType links();

/// Rows of the table of routes, by their method.
template <typename... Parameters>
Route on_get(const char* path, Scope scope, void (*function)(Parameters...), Operation says) {
  return {Method::get, path, scope, handler(function), std::move(says)};
}
template <typename... Parameters>
Route on_post(const char* path, Scope scope, void (*function)(Parameters...), Operation says) {
  return {Method::post, path, scope, handler(function), std::move(says)};
}
template <typename... Parameters>
Route on_patch(const char* path, Scope scope, void (*function)(Parameters...), Operation says) {
  return {Method::patch, path, scope, handler(function), std::move(says)};
}
template <typename... Parameters>
Route on_delete(const char* path, Scope scope, void (*function)(Parameters...), Operation says) {
  return {Method::remove, path, scope, handler(function), std::move(says)};
}
/// The route, which queues work for workers.
Route begins_work(Route route);
/// The route, whose calls are too many for the audit log.
Route unaudited(Route route);
/// The route, whose answer is a page that runs scripts of its own.
Route with_scripts(Route route);
/// The same routes, under a heading of the API's page.
std::vector<Route> tagged(const char* tag, std::vector<Route> routes);

}  // namespace throng::server
