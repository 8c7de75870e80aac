#include "server/api/session_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "server/access/keys.h"
#include "server/access/sessions.h"
#include "server/api/requests.h"
#include "server/http/http.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

constexpr const char* kAuthorization = "Authorization";

/// Whether the browser reaches the service by TLS, through a proxy.
bool is_behind_tls(const Request& request) {
  return request.get_header_value("X-Forwarded-Proto") == "https" ||
         request.get_header_value("Origin").starts_with("https://");
}

/// Names the port, because browsers send a cookie to all ports of a host. Behind TLS, the prefix
/// makes browsers refuse such a cookie from other hosts of the domain and from plain HTTP.
std::string cookie_name(const Request& request, bool is_secure) {
  const std::string prefix = is_secure ? "__Host-" : "";
  const std::string host = request.get_header_value("Host");
  const std::string port = host.substr(std::min(host.rfind(':'), host.size()));
  const bool is_port =
      port.size() > 1 && port.find_first_not_of("0123456789", 1) == std::string::npos;
  return prefix + (is_port ? "throng_session_" + port.substr(1) : "throng_session");
}

/// Value of the cookie of this name; "" without one.
std::string cookie_value(const Request& request, const std::string& name) {
  const std::string start = name + "=";
  const std::string header = request.get_header_value("Cookie");
  std::string_view rest = header;
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
    const auto begin = std::min(pair.find_first_not_of(' '), pair.size());
    if (pair.substr(begin).starts_with(start)) {
      return std::string(pair.substr(begin + start.size()));
    }
  }
  return "";
}

/// Token of the session; "" without one.
std::string token_in(const Request& request) {
  // A proxy that does not tell of TLS passes both kinds on.
  std::string token =
      is_behind_tls(request) ? "" : cookie_value(request, cookie_name(request, false));
  return token.empty() ? cookie_value(request, cookie_name(request, true)) : token;
}

/// Browsers name the site of the page that sends a request; "none" is the person at the address
/// bar. Requests that change something also have an Origin, which is checked for all callers.
bool is_of_own_page(const Request& request) {
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  if (!site.empty() && site != "same-origin" && site != "none") return false;
  return request.method == "GET" || request.method == "HEAD" || request.has_header("Origin");
}

void set_cookie(const Request& request, Response& response, const std::string& value,
                const char* more) {
  const bool is_secure = is_behind_tls(request);
  response.set_header("Set-Cookie", fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict{}{}",
                                                cookie_name(request, is_secure), value,
                                                is_secure ? "; Secure" : "", more));
}

void write_session(Keys& keys, const std::optional<Caller>& caller, Response& response) {
  response.set_header("Cache-Control", "no-store");
  write_json(response, 200,
             {{"needs_key", keys.are_needed()},
              {"scope", caller ? json(to_string(caller->scope)) : json(nullptr)}});
}

}  // namespace

std::string key_in(Sessions& sessions, const Request& request) {
  constexpr std::string_view kBearer = "Bearer ";
  const std::string header = request.get_header_value(kAuthorization);
  if (header.starts_with(kBearer)) return header.substr(kBearer.size());
  const std::string token = token_in(request);
  return token.empty() || !is_of_own_page(request) ? "" : sessions.key_of(token);
}

std::optional<Caller> caller_in(const Keys& keys, Sessions& sessions, const Request& request) {
  return keys.caller_of(key_in(sessions, request));
}

bool has_credentials(const Request& request) {
  return request.has_header(kAuthorization) || !token_in(request).empty();
}

void confirm_access(Response& response) {
  response.set_header("Cache-Control", "no-store");
  response.status = 204;
}

void open_session(Keys& keys, Sessions& sessions, const Request& request, Response& response) {
  require_json(request);
  const json body = parse_json_body(request);
  if (!body.contains("key") || !body["key"].is_string()) {
    throw HttpError{400, "a session needs a key", {{"", "/key", "nothing", "a key as text"}}};
  }
  const std::string key = body["key"];
  const auto caller = keys.caller_of(key);
  if (!caller) throw HttpError{401, keys.refusal_of(key)};
  sessions.close(token_in(request));
  set_cookie(request, response, sessions.open(key), "");
  write_session(keys, caller, response);
}

void send_session(Keys& keys, Sessions& sessions, const Request& request, Response& response) {
  write_session(keys, caller_in(keys, sessions, request), response);
}

void close_session(Sessions& sessions, const Request& request, Response& response) {
  sessions.close(token_in(request));
  set_cookie(request, response, "", "; Max-Age=0");
  response.status = 204;
}

}  // namespace throng::server
