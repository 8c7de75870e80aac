#include "server/api/service_api.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "server/access/keys.h"
#include "server/access/sessions.h"
#include "server/api/requests.h"
#include "server/api/session_api.h"
#include "server/catalog/api_json.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/service_folders.h"
#include "server/http/http.h"
#include "server/jobs/drain.h"
#include "server/jobs/job_queue.h"
#include "spec/documents/published_schemas.h"
#include "spec/job/spec.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

std::int64_t free_bytes(const ServiceFolders& folders) {
  return measure_disk(folders.data()).free_bytes;
}

/// The part of the job's schema at a pointer: how a job names what a list holds.
json schema_at(const char* pointer) { return jobs::job_schema().at(json::json_pointer(pointer)); }

}  // namespace

void send_health(Response& response) { write_json(response, 200, {{"status", "ok"}}); }

void send_readiness(JobQueue& queue, const ServiceFolders& folders, Drain& drain, Keys& keys,
                    Sessions& sessions, const Request& request, Response& response) {
  static_cast<void>(queue.count());  // throws when the store cannot be read
  queue.check_store();
  // Strangers learn no figures of the machine.
  const bool is_known = caller_in(keys, sessions, request).has_value();
  if (drain.has_begun()) throw HttpError{503, kDraining};
  if (const std::string reason = queue.paused(); !reason.empty()) {
    throw HttpError{503, is_known ? fmt::format("the queue is paused: {}", reason)
                                  : std::string("the queue is paused")};
  }
  json ready = {{"status", "ready"}};
  if (is_known) ready["free_bytes"] = free_bytes(folders);
  write_json(response, 200, ready);
}

void begin_drain(Drain& drain, Response& response) {
  drain.begin();
  write_json(response, 202, {{"status", "draining"}});
}

void send_version(Response& response) {
  write_json(response, 200, {{"name", "throng"}, {"version", THRONG_VERSION}, {"api", "v1"}});
}

void send_schema(Response& response) {
  response.set_content(std::string(jobs::job_schema_text()), "application/schema+json");
}

void list_schemas(Response& response) {
  write_json(response, 200, {{"schemas", jobs::schema_names()}});
}

void send_file_schema(const Request& request, Response& response) {
  const std::string name = request.matches[1];
  const std::string schema = jobs::published_schema(name);
  if (schema.empty()) {
    throw HttpError{404, fmt::format("there is no schema \"{}\", but there are: {}", name,
                                     fmt::join(jobs::schema_names(), ", "))};
  }
  response.set_content(schema, "application/schema+json");
}

void list_airframes(const ConfinedChecks& confined, Response& response) {
  write_json(response, 200,
             {{"airframes", confined.catalog().at("airframes")},
              {"schema", schema_at("/properties/drones/items/properties/airframe")}});
}

void list_formats(const ConfinedChecks& confined, Response& response) {
  write_json(response, 200,
             {{"formats", confined.catalog().at("formats")},
              {"schema", schema_at("/properties/outputs/properties/formats")}});
}

void list_policies(const ConfinedChecks& confined, Response& response) {
  write_json(
      response, 200,
      {{"policies", confined.catalog().at("policies")},
       {"schema", schema_at("/properties/drones/items/properties/guidance/properties/policy")}});
}

void list_people(const ConfinedChecks& confined, Response& response) {
  json people = confined.people();
  if (people.is_null()) {
    throw HttpError{404, "there is no character library on this machine: run throng people build"};
  }
  people["schema"] = schema_at("/properties/appearance");
  write_json(response, 200, people);
}

}  // namespace throng::server
