// Table entries of the API: paths with parameters, such as "/v1/jobs/{id}", and their patterns.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "server/access/keys.h"
#include "server/http/http_fwd.h"

namespace throng::server {

struct RequestContext;

enum class Method { get, post, patch, remove };

/// The HTTP method: "GET", "DELETE".
std::string_view to_string(Method method);

/// One operation of the API. A parameter's name determines its syntax: {id} lower-case letters and
/// digits, {n} digits, {name} letters, digits and ". _ -", {path} the rest of the path.
struct Route {
  Method method;
  const char* path;
  Scope scope;  ///< min scope of the caller
  void (*handler)(const RequestContext&, const httplib::Request&, httplib::Response&);
};

/// The path as a regular expression for the library; httplib::Request::matches holds the parameters
/// from index 1 on.
std::string route_pattern(std::string_view path);

/// Whether a requested path matches the path of a route.
bool fits(std::string_view path, std::string_view requested);

/// The Allow header for a requested path: "GET, HEAD, POST"; "" if no route matches.
std::string allowed_methods(std::span<const Route> routes, std::string_view requested);

}  // namespace throng::server
