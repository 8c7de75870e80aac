#include "server/scenarios_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "jobs/spec/scenario_summary.h"
#include "server/answers.h"
#include "server/http.h"
#include "server/requests.h"
#include "world/scenario.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

json upload_json(const ScenarioUpload& upload) {
  return {{"name", upload.name},
          {"owner", upload.owner},
          {"created_at", time_json(upload.created_ms)},
          {"bytes", upload.bytes},
          {"files", upload.files}};
}

json findings_json(const std::vector<jobs::ScenarioFinding>& findings) {
  json list = json::array();
  for (const jobs::ScenarioFinding& finding : findings) {
    list.push_back(problems_json({finding.problem}).front());
    list.back()["severity"] = finding.is_error ? "error" : "warning";
    list.back()["remedy"] = finding.remedy;
  }
  return list;
}

/// Uploaded scenarios are known from their check: this process does not load them.
json summary_of(const Call& call, const std::string& id,
                const std::optional<ScenarioUpload>& upload) {
  if (!upload) {
    return jobs::scenario_summary(world::find_scenario(call.folders.scenarios(), id));
  }
  const auto found = std::find(upload->ids.begin(), upload->ids.end(), id);
  const auto index = static_cast<std::size_t>(found - upload->ids.begin());
  if (index >= upload->summaries.size()) {
    throw InputError(Problem{id, "", "a scenario that was not there when it was uploaded",
                             "one that can be loaded; upload it again"});
  }
  return upload->summaries[index];
}

json scenario_json(const Call& call, const std::string& id) {
  const auto upload = call.uploads.scenarios().find(upload_of(id));
  json value = summary_of(call, id, upload);
  value["id"] = id;
  value["uploaded"] = upload ? upload_json(*upload) : json(nullptr);
  return value;
}

/// Whether the body is a blueprint; else it is a bundle. Throws HttpError for anything else.
bool is_blueprint(const Request& request) {
  constexpr std::array kTypes = {"application/zip",    "application/x-zip-compressed",
                                 "application/x-tar",  "application/gzip",
                                 "application/x-gzip", "application/octet-stream"};
  const std::string header = request.get_header_value("Content-Type");
  const std::string type = header.substr(0, header.find(';'));
  if (type == "application/json") return true;
  if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
    throw HttpError{415,
                    "a bundle is sent with Content-Type: application/zip, application/x-tar or "
                    "application/gzip, a blueprint with application/json"};
  }
  return false;
}

}  // namespace

void upload_scenarios(const Call& call, const Request& request, Response& response) {
  const bool from_blueprint = is_blueprint(request);
  const std::string name = request.get_param_value("name");
  ScenarioStore& uploads = call.uploads.scenarios();
  if (is_bundle_name(name)) throw HttpError{409, "names like this are those of jobs' own bundles"};
  if (uploads.is_taken(name)) {
    throw HttpError{409, fmt::format("there are scenarios named \"{}\" already", name)};
  }
  try {
    ScenarioStore::Staged staged =
        from_blueprint ? uploads.stage_blueprint(name, json_body_of(request), call.caller.key_id)
                       : uploads.stage(name, request.body, call.caller.key_id);
    const bool dry = is_asked(request, "dry_run");
    const ScenarioUpload upload = dry ? staged.upload : uploads.publish(staged);
    json value = upload_json(upload);
    value["ids"] = upload.ids;
    value["findings"] = findings_json(staged.findings);
    if (!dry) response.set_header("Location", "/v1/scenarios/" + upload.ids.front());
    write_json(response, dry ? 200 : 201, value);
  } catch (const InputError& error) {
    throw HttpError{400,
                    from_blueprint ? "no scenario can be made of the blueprint"
                                   : "the bundle cannot be used as it stands",
                    call.folders.without_paths(error.problems())};
  }
}

void list_scenarios(const Call& call, const Request&, Response& response) {
  json list = json::array();
  for (const std::string& id : world::list_scenarios(call.folders.scenarios())) {
    if (is_bundle_name(upload_of(id))) continue;  // of one job, and of no use to others
    try {
      list.push_back(scenario_json(call, id));
    } catch (const InputError& error) {
      // One that is damaged hides no other.
      list.push_back({{"id", id}, {"error", call.folders.without_paths(error.what())}});
    }
  }
  write_json(response, 200, {{"scenarios", std::move(list)}});
}

void send_scenario(const Call& call, const Request& request, Response& response) {
  const std::string id = request.matches[1];
  const auto all = world::list_scenarios(call.folders.scenarios());
  if (std::find(all.begin(), all.end(), id) == all.end()) {
    throw HttpError{404, "there is no such scenario; GET /v1/scenarios lists them"};
  }
  const std::string format = request.get_param_value("format");
  if (format == "svg") {
    return response.set_content(call.confined.scenario_plan(id, call.folders.scenarios()),
                                "image/svg+xml");
  }
  if (format == "blueprint") {
    const json blueprint = call.confined.blueprint(id, call.folders.scenarios());
    if (blueprint.is_null()) throw HttpError{404, "this scenario was not made from a blueprint"};
    return write_json(response, 200, blueprint);
  }
  if (!format.empty() && format != "json") {
    throw HttpError{400, "format is wrong", {{"", "?format", format, "json, svg or blueprint"}}};
  }
  write_json(response, 200, scenario_json(call, id));
}

void send_job_plan(const Call& call, const Request& request, Response& response) {
  const jobs::JobRow row = find_job(call, request);
  response.set_content(call.confined.job_plan(row.spec_json, call.folders.scenarios()),
                       "image/svg+xml");
}

void remove_scenarios(const Call& call, const Request& request, Response& response) {
  const std::string name = request.matches[1];
  const auto upload = call.uploads.scenarios().find(name);
  if (!upload || is_bundle_name(name)) {
    throw HttpError{404,
                    "there is no such upload; its name is the first part of its scenarios' ids"};
  }
  if (call.caller.scope < Scope::admin && upload->owner != call.caller.key_id) {
    throw HttpError{403,
                    "the upload is another's: only its owner and administrators may remove it"};
  }
  if (!call.uploads.remove(name)) throw HttpError{404, "already removed"};
  response.status = 204;
}

}  // namespace throng::server
