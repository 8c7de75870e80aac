// The routes of each resource: how they are asked for, what they say, who answers.
#pragma once

#include <vector>

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

/// A row of the table of routes, by its method.
Route on_get(const char* path, Scope scope, Handler handler, Operation says);
Route on_post(const char* path, Scope scope, Handler handler, Operation says);
Route on_patch(const char* path, Scope scope, Handler handler, Operation says);
Route on_delete(const char* path, Scope scope, Handler handler, Operation says);
/// The same routes, under a heading of the API's page.
std::vector<Route> tagged(const char* tag, std::vector<Route> routes);

}  // namespace throng::server
