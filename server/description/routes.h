// Table entries of the API: paths with parameters, such as "/v1/jobs/{id}", and their patterns.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/access/keys.h"
#include "server/description/operation.h"
#include "server/http/http_fwd.h"

namespace throng::server {

struct HandlerArguments;

enum class Method { get, post, patch, remove };

/// The HTTP method: "GET", "DELETE".
std::string_view to_string(Method method);

/// Answers a request; throws HttpError, InputError and EnvironmentError.
using Handler = std::function<void(const HandlerArguments&)>;

/// One operation of the API. A parameter's name determines its syntax: {id} lower-case letters and
/// digits, {n} digits, {name} letters, digits and ". _ -", {path} the rest of the path.
struct Route {
  Method method;
  const char* path;
  Scope scope;  ///< min scope of the caller
  Handler handler;
  Operation says = {};       ///< for openapi.json; empty for the page's files
  bool begins_work = false;  ///< it queues work for workers: not while the service drains
  bool is_audited = true;    ///< if it changes something
  bool has_scripts = false;  ///< the answer is a page that runs scripts of its own
};

/// A parameter in a path.
struct PathParameter {
  std::string_view name;
  std::string_view pattern;  ///< of its values, a regular expression
  bool (*allows)(char);
  bool is_rest;  ///< of the path, with slashes
};
/// The parameters of a path, in their order.
std::vector<PathParameter> path_parameters(std::string_view path);

/// The path as a regular expression for the library; httplib::Request::matches holds the parameters
/// from index 1 on.
std::string route_pattern(std::string_view path);

/// Whether a requested path matches the path of a route.
bool fits(std::string_view path, std::string_view requested);

/// The Allow header for a requested path: "GET, HEAD, POST"; "" if no route matches.
std::string allowed_methods(std::span<const Route> routes, std::string_view requested);

}  // namespace throng::server
