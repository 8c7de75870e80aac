// Paths with parameters, such as "/v1/jobs/{id}", and what the library needs to know of them.
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

/// "GET", "DELETE"
std::string_view to_string(Method method);

/// One operation of the API. A parameter's name determines its syntax: {id} small letters and
/// digits, {n} digits, {name} letters, digits and ". _ -", {path} the rest of the path.
struct Route {
  Method method;
  const char* path;
  Scope scope;  ///< that a caller must have
  void (*handler)(const RequestContext&, const httplib::Request&, httplib::Response&);
};

/// The path as the library's pattern: Request::matches holds the parameters from 1 on.
std::string route_pattern(std::string_view path);

/// Whether a request's path is one of these.
bool fits(std::string_view path, std::string_view requested);

/// The Allow header of a requested path: "GET, HEAD, POST"; "" when no route knows it.
std::string allowed_methods(std::span<const Route> routes, std::string_view requested);

}  // namespace throng::server
