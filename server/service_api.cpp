#include "server/service_api.h"

#include <fmt/core.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json_text.h"
#include "formats/exporter.h"
#include "jobs/spec/spec.h"
#include "server/answers.h"
#include "server/http.h"
#include "server/requests.h"
#include "sim/airframe.h"
#include "sim/battery.h"
#include "sim/policy.h"
#include "skinning/items.h"
#include "skinning/population.h"
#include "skinning/population_files.h"

namespace throng::embedded {
extern const std::string_view kOpenApi;
}  // namespace throng::embedded

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// Memory of this process that is in RAM; 0 where the kernel does not say.
std::int64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  file >> total >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

std::int64_t free_bytes(const Call& call) { return free_bytes_of(call.service.data_folder()); }

/// The part of the job's schema at a pointer: how a job names what a list holds.
json schema_at(const char* pointer) {
  static const json kSchema = parse_own_json(jobs::job_schema(), "the schema");
  return kSchema.at(json::json_pointer(pointer));
}

}  // namespace

void send_health(const Call&, const Request&, Response& response) {
  write_json(response, 200, {{"status", "ok"}});
}

void send_readiness(const Call& call, const Request&, Response& response) {
  static_cast<void>(call.service.count());  // throws when the store cannot be read
  if (const std::string reason = call.service.paused(); !reason.empty()) {
    throw HttpError{503, fmt::format("the queue rests: {}", reason)};
  }
  write_json(response, 200, {{"status", "ready"}, {"free_bytes", free_bytes(call)}});
}

void send_figures(const Call& call, const Request&, Response& response) {
  std::string text =
      "# HELP throng_jobs Jobs and calibrations by state.\n# TYPE throng_jobs gauge\n";
  for (const auto& [state, count] : call.service.count()) {
    text += fmt::format("throng_jobs{{state=\"{}\"}} {}\n", name_of(state), count);
  }
  const auto add = [&](const char* name, const char* type, const char* help, auto value) {
    text += fmt::format("# HELP {0} {1}\n# TYPE {0} {2}\n{0} {3}\n", name, help, type, value);
  };
  add("throng_events_total", "counter", "Events of jobs since the store was made.",
      call.service.last_event());
  add("throng_event_streams", "gauge", "Clients that watch events.", call.service.watchers());
  add("throng_queue_paused", "gauge", "1 while the queue rests because the disk is full.",
      call.service.paused().empty() ? 0 : 1);
  add("throng_disk_free_bytes", "gauge", "Free bytes where the data folder lies.",
      free_bytes(call));
  add("process_resident_memory_bytes", "gauge", "Memory of the server in RAM.", resident_bytes());
  response.set_content(text, "text/plain; version=0.0.4; charset=utf-8");
}

void send_version(const Call&, const Request&, Response& response) {
  write_json(response, 200, {{"name", "throng"}, {"version", THRONG_VERSION}, {"api", "v1"}});
}

void send_schema(const Call&, const Request&, Response& response) {
  response.set_content(std::string(jobs::job_schema()), "application/schema+json");
}

void send_openapi(const Call&, const Request&, Response& response) {
  response.set_content(std::string(embedded::kOpenApi), "application/json");
}

void list_airframes(const Call&, const Request&, Response& response) {
  json list = json::array();
  for (const sim::Airframe& airframe : sim::shipped_airframes()) {
    json entry = to_json(airframe);
    entry["name"] = airframe.name;
    entry["derived"] = {{"top_speed_mps", airframe.top_speed_mps()},
                        {"endurance_s", airframe.endurance_s()},
                        {"hover_power_w", sim::hover_power_w(airframe)}};
    list.push_back(std::move(entry));
  }
  write_json(response, 200,
             {{"airframes", std::move(list)},
              {"schema", schema_at("/properties/drones/items/properties/airframe")}});
}

void list_formats(const Call&, const Request&, Response& response) {
  json list = json::array();
  for (const formats::Format& format : formats::all_formats()) {
    list.push_back({{"name", format.name}, {"summary", format.summary}, {"needs", format.needs}});
  }
  write_json(response, 200,
             {{"formats", std::move(list)},
              {"schema", schema_at("/properties/outputs/properties/formats")}});
}

void list_policies(const Call&, const Request&, Response& response) {
  json list = json::array();
  for (const sim::PolicyEntry& policy : sim::policies()) {
    list.push_back({{"name", policy.name}, {"flies_free", policy.flies_free}});
  }
  write_json(
      response, 200,
      {{"policies", std::move(list)},
       {"schema", schema_at("/properties/drones/items/properties/guidance/properties/policy")}});
}

void list_people(const Call&, const Request&, Response& response) {
  const fs::path folder = skinning::population_folder();
  if (!fs::exists(folder / skinning::kIndexFile)) {
    throw HttpError{404, "no people have been baked on this machine: throng people build"};
  }
  const skinning::PopulationIndex index = skinning::read_index(folder);
  json list = json::array();
  for (const skinning::Character& who : index.characters) {
    list.push_back({{"name", who.name},
                    {"sex", who.male ? "male" : "female"},
                    {"age_years", who.age_years},
                    {"stature_m", who.stature_m},
                    {"carries", skinning::kCarryNames[static_cast<std::size_t>(who.carries)]},
                    {"wears", who.wears}});
  }
  write_json(response, 200,
             {{"content_hash", index.content_hash},
              {"licence", index.licence},
              {"people", std::move(list)},
              {"schema", schema_at("/properties/appearance")}});
}

}  // namespace throng::server
