#include "server/api/routes.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace throng::server {

namespace {

bool is_small_or_digit(char c) { return ('0' <= c && c <= '9') || ('a' <= c && c <= 'z'); }
bool is_digit(char c) { return '0' <= c && c <= '9'; }
bool is_of_name(char c) {
  return is_small_or_digit(c) || ('A' <= c && c <= 'Z') || c == '.' || c == '_' || c == '-';
}
bool is_any(char) { return true; }

struct Parameter {
  std::string_view name;  ///< with its braces
  std::string_view pattern;
  bool (*allows)(char);
  bool is_rest;  ///< of the path, with slashes
};
constexpr std::array kParameters = {Parameter{"{id}", "([a-z0-9]+)", &is_small_or_digit, false},
                                    Parameter{"{n}", "([0-9]+)", &is_digit, false},
                                    Parameter{"{name}", "([A-Za-z0-9._-]+)", &is_of_name, false},
                                    Parameter{"{path}", "(.+)", &is_any, true}};

const Parameter& parameter_at(std::string_view path, std::size_t brace) {
  const auto* found = std::find_if(
      kParameters.begin(), kParameters.end(),
      [&](const Parameter& entry) { return path.substr(brace).starts_with(entry.name); });
  return *found;
}

}  // namespace

std::string_view to_string(Method method) {
  switch (method) {
    case Method::get:
      return "GET";
    case Method::post:
      return "POST";
    case Method::patch:
      return "PATCH";
    case Method::remove:
      break;
  }
  return "DELETE";
}

std::string route_pattern(std::string_view path) {
  std::string pattern;
  for (std::size_t i = 0; i < path.size();) {
    if (path[i] != '{') {
      pattern += path[i] == '.' ? std::string("\\.") : std::string(1, path[i]);
      ++i;
      continue;
    }
    const Parameter& parameter = parameter_at(path, i);
    pattern += parameter.pattern;
    i += parameter.name.size();
  }
  return pattern;
}

bool fits(std::string_view path, std::string_view requested) {
  for (std::size_t brace = path.find('{'); brace != std::string_view::npos;
       brace = path.find('{')) {
    if (!requested.starts_with(path.substr(0, brace))) return false;
    requested.remove_prefix(brace);
    const Parameter& parameter = parameter_at(path, brace);
    path.remove_prefix(brace + parameter.name.size());
    const std::string_view value =
        parameter.is_rest ? requested : requested.substr(0, requested.find('/'));
    // A suffix of a parameter within its segment, such as ".csv", does not belong to it.
    const std::string_view suffix = path.substr(0, std::min(path.find('/'), path.size()));
    const std::string_view own =
        value.ends_with(suffix) ? value.substr(0, value.size() - suffix.size()) : value;
    if (own.empty() || !std::all_of(own.begin(), own.end(), parameter.allows)) return false;
    requested.remove_prefix(own.size());
  }
  return path == requested;
}

std::string allowed_methods(std::span<const Route> routes, std::string_view requested) {
  std::string methods;
  for (const Route& route : routes) {
    if (!fits(route.path, requested)) continue;
    if (!methods.empty()) methods += ", ";
    methods += route.method == Method::get ? "GET, HEAD" : to_string(route.method);
  }
  return methods;
}

}  // namespace throng::server
