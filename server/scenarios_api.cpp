#include "server/scenarios_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "jobs/pipeline/pipeline.h"
#include "jobs/spec/job_scenario.h"
#include "places/plan.h"
#include "server/answers.h"
#include "server/http.h"
#include "server/requests.h"
#include "sim/planned_paths.h"
#include "world/scenario.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr int kPlanPx = 1200;  // the longer side

json upload_json(const ScenarioUpload& upload) {
  return {{"name", upload.name},
          {"owner", upload.owner},
          {"created_at", time_json(upload.created_ms)},
          {"bytes", upload.bytes},
          {"files", upload.files}};
}

json findings_json(const std::vector<places::Finding>& findings) {
  json list = json::array();
  for (const places::Finding& finding : findings) {
    list.push_back(problems_json({finding.problem}).front());
    list.back()["severity"] = finding.severity == places::Severity::error ? "error" : "warning";
    list.back()["remedy"] = finding.remedy;
  }
  return list;
}

json scenario_json(const Call& call, const std::string& id) {
  const world::Scenario scenario = world::find_scenario(call.service.scenarios(), id);
  json exits = json::array();
  for (const world::Exit& exit : scenario.exits) {
    exits.push_back({{"id", exit.id}, {"width_m", exit.width_m()}, {"open", exit.open}});
  }
  json drones = json::array();
  for (const world::DroneStart& drone : scenario.drones) {
    drones.push_back({{"id", drone.id},
                      {"start_m", {drone.position.x(), drone.position.y(), drone.position.z()}}});
  }
  const world::Rectangle& ground = scenario.ground;
  const auto upload = call.service.uploads().find(upload_of(id));
  return {
      {"id", id},
      {"name", scenario.name},
      {"description", scenario.description},
      {"crowd_model", scenario.crowd_model.empty() ? json(nullptr) : json(scenario.crowd_model)},
      {"ground_m", {ground.min.x(), ground.min.y(), ground.max.x(), ground.max.y()}},
      {"exits", std::move(exits)},
      {"drones", std::move(drones)},
      {"buildings", scenario.buildings.size()},
      {"props", scenario.props.size()},
      {"uploaded", upload ? upload_json(*upload) : json(nullptr)}};
}

void require_bundle(const Request& request) {
  constexpr std::array kTypes = {"application/zip",    "application/x-zip-compressed",
                                 "application/x-tar",  "application/gzip",
                                 "application/x-gzip", "application/octet-stream"};
  const std::string header = request.get_header_value("Content-Type");
  const std::string type = header.substr(0, header.find(';'));
  if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
    throw HttpError{415,
                    "a bundle is sent with Content-Type: application/zip, application/x-tar or "
                    "application/gzip"};
  }
}

}  // namespace

void upload_scenarios(const Call& call, const Request& request, Response& response) {
  require_bundle(request);
  const std::string name = request.get_param_value("name");
  ScenarioStore& uploads = call.service.uploads();
  if (is_bundle_name(name)) throw HttpError{409, "names like this are those of jobs' own bundles"};
  if (uploads.is_taken(name)) {
    throw HttpError{409, fmt::format("there are scenarios named \"{}\" already", name)};
  }
  try {
    ScenarioStore::Staged staged = uploads.stage(name, request.body, call.caller.key_id);
    const bool dry = is_asked(request, "dry_run");
    const ScenarioUpload upload = dry ? staged.upload : uploads.publish(staged);
    json value = upload_json(upload);
    value["ids"] = upload.ids;
    value["findings"] = findings_json(staged.findings);
    if (!dry) response.set_header("Location", "/v1/scenarios/" + upload.ids.front());
    write_json(response, dry ? 200 : 201, value);
  } catch (const InputError& error) {
    throw HttpError{400, "the bundle cannot be used as it stands",
                    call.service.without_paths(error.problems())};
  }
}

void list_scenarios(const Call& call, const Request&, Response& response) {
  json list = json::array();
  for (const std::string& id : world::list_scenarios(call.service.scenarios())) {
    if (is_bundle_name(upload_of(id))) continue;  // of one job, and of no use to others
    try {
      list.push_back(scenario_json(call, id));
    } catch (const InputError& error) {
      // One that is damaged hides no other.
      list.push_back({{"id", id}, {"error", call.service.without_paths(error.what())}});
    }
  }
  write_json(response, 200, {{"scenarios", std::move(list)}});
}

void send_scenario(const Call& call, const Request& request, Response& response) {
  const std::string id = request.matches[1];
  const auto all = world::list_scenarios(call.service.scenarios());
  if (std::find(all.begin(), all.end(), id) == all.end()) {
    throw HttpError{404, "there is no such scenario; GET /v1/scenarios lists them"};
  }
  const std::string format = request.get_param_value("format");
  if (format == "svg") {
    const world::Scenario scenario = world::find_scenario(call.service.scenarios(), id);
    return response.set_content(places::to_svg(places::draw_plan(scenario, kPlanPx)),
                                "image/svg+xml");
  }
  if (!format.empty() && format != "json") {
    throw HttpError{400, "format is wrong", {{"", "?format", format, "json or svg"}}};
  }
  write_json(response, 200, scenario_json(call, id));
}

void send_job_plan(const Call& call, const Request& request, Response& response) {
  const jobs::JobRow row = find_job(call, request);
  const fs::path& folder = call.service.scenarios();
  const jobs::JobSpec job = jobs::parse_job(row.spec_json, "", folder);
  const world::Scenario scenario = jobs::scenario_of(job, folder);
  const auto paths = sim::planned_paths(scenario, jobs::run_spec(job, 0));
  response.set_content(places::to_svg(places::draw_plan(scenario, kPlanPx, paths)),
                       "image/svg+xml");
}

void remove_scenarios(const Call& call, const Request& request, Response& response) {
  const std::string name = request.matches[1];
  const auto upload = call.service.uploads().find(name);
  if (!upload || is_bundle_name(name)) {
    throw HttpError{404,
                    "there is no such upload; its name is the first part of its scenarios' ids"};
  }
  if (call.caller.scope < Scope::admin && upload->owner != call.caller.key_id) {
    throw HttpError{403,
                    "the upload is another's: only its owner and administrators may remove it"};
  }
  if (!call.service.remove_scenarios(name)) throw HttpError{404, "already removed"};
  response.status = 204;
}

}  // namespace throng::server
