#include "server/api/service_api.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "server/api/requests.h"
#include "server/api/session_api.h"
#include "server/catalog/api_json.h"
#include "server/http/http.h"
#include "spec/documents/published_schemas.h"
#include "spec/job/spec.h"

namespace throng::embedded {
extern const std::string_view kOpenApi;
}  // namespace throng::embedded

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

/// Memory of this process that is in RAM; 0 where the kernel does not report it.
std::int64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  file >> total >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

/// Prometheus figures of a cluster's nodes; "" if tasks run on this machine.
std::string figures_of_nodes(const std::vector<jobs::NodeWork>& nodes) {
  if (nodes.empty()) return "";
  std::string running =
      "# HELP throng_node_tasks Tasks that run now, by node.\n"
      "# TYPE throng_node_tasks gauge\n";
  std::string ended =
      "# HELP throng_node_attempts_total Attempts at tasks that ended since the start, by node.\n"
      "# TYPE throng_node_attempts_total counter\n";
  std::string busy =
      "# HELP throng_node_busy_seconds_total Time of these attempts.\n"
      "# TYPE throng_node_busy_seconds_total counter\n";
  for (const jobs::NodeWork& work : nodes) {
    running += fmt::format("throng_node_tasks{{node=\"{}\"}} {}\n", work.node, work.running);
    ended += fmt::format(
        "throng_node_attempts_total{{node=\"{0}\",outcome=\"succeeded\"}} {1}\n"
        "throng_node_attempts_total{{node=\"{0}\",outcome=\"failed\"}} {2}\n",
        work.node, work.done, work.failed);
    busy += fmt::format("throng_node_busy_seconds_total{{node=\"{}\"}} {:.1f}\n", work.node,
                        work.busy_s);
  }
  return running + ended + busy;
}

std::int64_t free_bytes(const RequestContext& context) {
  return measure_disk(context.folders.data()).free_bytes;
}

/// The part of the job's schema at a pointer: how a job names what a list holds.
json schema_at(const char* pointer) { return jobs::job_schema().at(json::json_pointer(pointer)); }

}  // namespace

void send_health(const RequestContext&, const Request&, Response& response) {
  write_json(response, 200, {{"status", "ok"}});
}

void send_readiness(const RequestContext& context, const Request& request, Response& response) {
  static_cast<void>(context.queue.count());  // throws when the store cannot be read
  context.queue.check_store();
  // Strangers learn no figures of the machine.
  const bool is_known = caller_in(context.keys, context.sessions, request).has_value();
  if (const std::string reason = context.queue.paused(); !reason.empty()) {
    throw HttpError{503, is_known ? fmt::format("the queue is paused: {}", reason)
                                  : std::string("the queue is paused")};
  }
  json ready = {{"status", "ready"}};
  if (is_known) ready["free_bytes"] = free_bytes(context);
  write_json(response, 200, ready);
}

void send_figures(const RequestContext& context, const Request&, Response& response) {
  std::string text =
      "# HELP throng_jobs Jobs, calibrations and studies by state.\n# TYPE throng_jobs gauge\n";
  for (const auto& [state, count] : context.queue.count()) {
    text += fmt::format("throng_jobs{{state=\"{}\"}} {}\n", to_string(state), count);
  }
  const auto add = [&](const char* name, const char* type, const char* help, auto value) {
    text += fmt::format("# HELP {0} {1}\n# TYPE {0} {2}\n{0} {3}\n", name, help, type, value);
  };
  add("throng_events_total", "counter", "Events of jobs since the store was made.",
      context.queue.last_event());
  add("throng_event_streams", "gauge", "Clients that watch events.", context.queue.watchers());
  add("throng_queue_paused", "gauge", "1 while the queue is paused because the disk is full.",
      context.queue.paused().empty() ? 0 : 1);
  text += figures_of_nodes(context.executor.nodes());
  add("throng_disk_free_bytes", "gauge", "Free bytes where the data folder lies.",
      free_bytes(context));
  add("process_resident_memory_bytes", "gauge", "Memory of the server in RAM.", resident_bytes());
  response.set_content(text, "text/plain; version=0.0.4; charset=utf-8");
}

void send_version(const RequestContext&, const Request&, Response& response) {
  write_json(response, 200, {{"name", "throng"}, {"version", THRONG_VERSION}, {"api", "v1"}});
}

void send_schema(const RequestContext&, const Request&, Response& response) {
  response.set_content(std::string(jobs::job_schema_text()), "application/schema+json");
}

void list_schemas(const RequestContext&, const Request&, Response& response) {
  write_json(response, 200, {{"schemas", jobs::schema_names()}});
}

void send_file_schema(const RequestContext&, const Request& request, Response& response) {
  const std::string name = request.matches[1];
  const std::string schema = jobs::published_schema(name);
  if (schema.empty()) {
    throw HttpError{404, fmt::format("there is no schema \"{}\", but there are: {}", name,
                                     fmt::join(jobs::schema_names(), ", "))};
  }
  response.set_content(schema, "application/schema+json");
}

void send_openapi(const RequestContext&, const Request&, Response& response) {
  response.set_content(std::string(embedded::kOpenApi), "application/json");
}

void list_airframes(const RequestContext& context, const Request&, Response& response) {
  write_json(response, 200,
             {{"airframes", context.confined.catalog().at("airframes")},
              {"schema", schema_at("/properties/drones/items/properties/airframe")}});
}

void list_formats(const RequestContext& context, const Request&, Response& response) {
  write_json(response, 200,
             {{"formats", context.confined.catalog().at("formats")},
              {"schema", schema_at("/properties/outputs/properties/formats")}});
}

void list_policies(const RequestContext& context, const Request&, Response& response) {
  write_json(
      response, 200,
      {{"policies", context.confined.catalog().at("policies")},
       {"schema", schema_at("/properties/drones/items/properties/guidance/properties/policy")}});
}

void list_people(const RequestContext& context, const Request&, Response& response) {
  json people = context.confined.people();
  if (people.is_null()) {
    throw HttpError{404, "there is no character library on this machine: run throng people build"};
  }
  people["schema"] = schema_at("/properties/appearance");
  write_json(response, 200, people);
}

}  // namespace throng::server
