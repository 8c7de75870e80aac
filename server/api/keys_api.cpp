#include "server/api/keys_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "base/json/json_integer.h"
#include "server/access/expiry.h"
#include "server/access/keys.h"
#include "server/api/requests.h"
#include "server/catalog/api_json.h"
#include "server/http/http.h"
#include "server/jobs/revoked_keys.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

constexpr const char* kKeyNoun = "key";

json limit_json(std::int64_t limit) { return limit == 0 ? json(nullptr) : json(limit); }

json key_json(const KeyRow& key) {
  return {{"id", key.id},
          {"name", key.name},
          {"scope", to_string(key.scope)},
          {"max_jobs", limit_json(key.max_active)},
          {"max_bytes", limit_json(key.max_bytes)},
          {"max_priority", key.scope >= Scope::admin ? kMaxPriority : key.max_priority},
          {"created_at", time_json(key.created_ms)},
          {"revoked_at", time_json(key.revoked_ms)},
          {"expires_at", time_json(key.expires_ms)},
          {"links", {{"self", "/v1/keys/" + key.id}}}};
}

KeyRow find_key(Keys& keys, const std::string& id) {
  const std::vector<KeyRow> all = keys.list();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const KeyRow& key) { return key.id == id; });
  if (found == all.end()) throw HttpError{404, fmt::format("there is no key {}", id)};
  return *found;
}

/// 0 where it is left out or null.
std::int64_t integer_in(const json& body, const char* name, std::int64_t min_number,
                        std::int64_t max_number) {
  const json value = body.value(name, json(nullptr));
  if (value.is_null()) return 0;
  if (is_integer(value) && value >= min_number && value <= max_number) return value;
  throw wrong_field(kKeyNoun, fmt::format("/{}", name), value.dump(),
                    fmt::format("an integer from {} to {}, or null", min_number, max_number));
}

std::string name_in(const json& body) {
  const json value = body.value("name", json(""));
  const std::string name = value.is_string() ? value.get<std::string>() : "";
  if (is_key_name(name)) return name;
  throw wrong_field(kKeyNoun, "/name", value.dump(), kKeyNameRule);
}

Scope scope_in(const json& body) {
  const json value = body.value("scope", json("submit"));
  const auto scope = value.is_string() ? scope_named(value.get<std::string>()) : std::nullopt;
  if (!scope) throw wrong_field(kKeyNoun, "/scope", value.dump(), "read, submit or admin");
  return *scope;
}

/// Unix time; 0 where it is left out or null.
std::int64_t expiry_in(const json& body) {
  const json value = body.value("expires_at", json(nullptr));
  if (value.is_null()) return 0;
  const auto expires_ms = value.is_string() ? parse_expiry(value.get<std::string>()) : std::nullopt;
  if (expires_ms) return *expires_ms;
  throw wrong_field(kKeyNoun, "/expires_at", value.dump(), kExpiryRule);
}

}  // namespace

void create_key(Keys& keys, const Request& request, Response& response) {
  if (!keys.are_needed()) {
    throw HttpError{403,
                    "the first key is made on the machine of the service: throng keys create NAME "
                    "--scope admin --data DIR"};
  }
  const json body = json_fields(
      request, kKeyNoun, {"name", "scope", "max_jobs", "max_bytes", "max_priority", "expires_at"});
  const std::string name = name_in(body);
  const auto max_jobs = integer_in(body, "max_jobs", 0, std::numeric_limits<int>::max());
  const auto max_bytes = integer_in(body, "max_bytes", 0, std::numeric_limits<std::int64_t>::max());
  const auto max_priority = integer_in(body, "max_priority", -kMaxPriority, kMaxPriority);
  const std::string token = keys.create(name, scope_in(body), static_cast<int>(max_jobs), max_bytes,
                                        static_cast<int>(max_priority), expiry_in(body));
  json answer = key_json(keys.row_of(token).value());
  answer["key"] = token;  // this once
  response.set_header("Location", answer["links"]["self"].get<std::string>());
  response.set_header("Cache-Control", "no-store");
  write_json(response, 201, answer);
}

void list_keys(Keys& keys, Response& response) {
  json list = json::array();
  for (const KeyRow& key : keys.list()) list.push_back(key_json(key));
  write_json(response, 200, {{"keys", std::move(list)}});
}

void revoke_key(Keys& keys, const RevokedKeys& revoked, const Caller& caller,
                const Request& request, Response& response) {
  const KeyRow key = find_key(keys, request.matches[1]);
  if (key.id == caller.key_id) {
    throw HttpError{409, "this key makes the request: revoke it with another one"};
  }
  if (!keys.revoke(key.id)) throw HttpError{409, "the key is revoked already"};
  const RevokedKeys::Ended ended = revoked.end_work();
  json answer = key_json(find_key(keys, key.id));
  answer["ended"] = {{"jobs", ended.jobs}, {"live_flights", ended.live_flights}};
  write_json(response, 200, answer);
}

}  // namespace throng::server
