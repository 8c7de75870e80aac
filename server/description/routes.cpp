#include "server/description/routes.h"

#include <fmt/core.h>

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

constexpr std::array kPathParameters = {
    PathParameter{"id", "[a-z0-9]+", &is_small_or_digit, false},
    PathParameter{"n", "[0-9]+", &is_digit, false},
    PathParameter{"name", "[A-Za-z0-9._-]+", &is_of_name, false},
    PathParameter{"path", ".+", &is_any, true}};

/// The parameter whose braces begin at `brace`.
const PathParameter& parameter_at(std::string_view path, std::size_t brace) {
  const std::string_view name = path.substr(brace + 1, path.find('}', brace) - brace - 1);
  return *std::find_if(kPathParameters.begin(), kPathParameters.end(),
                       [&](const PathParameter& entry) { return entry.name == name; });
}

}  // namespace

std::vector<PathParameter> path_parameters(std::string_view path) {
  std::vector<PathParameter> all;
  for (std::size_t i = path.find('{'); i != std::string_view::npos; i = path.find('{', i + 1)) {
    all.push_back(parameter_at(path, i));
  }
  return all;
}

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
    const PathParameter& parameter = parameter_at(path, i);
    pattern += fmt::format("({})", parameter.pattern);
    i += parameter.name.size() + 2;
  }
  return pattern;
}

bool fits(std::string_view path, std::string_view requested) {
  for (std::size_t brace = path.find('{'); brace != std::string_view::npos;
       brace = path.find('{')) {
    if (!requested.starts_with(path.substr(0, brace))) return false;
    requested.remove_prefix(brace);
    const PathParameter& parameter = parameter_at(path, brace);
    path.remove_prefix(brace + parameter.name.size() + 2);
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
