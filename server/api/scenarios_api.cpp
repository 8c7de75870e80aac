#include "server/api/scenarios_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "base/error.h"
#include "server/access/keys.h"
#include "server/api/list_answer.h"
#include "server/api/requests.h"
#include "server/catalog/api_json.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/uploads.h"
#include "server/http/answer_budget.h"
#include "server/http/http.h"
#include "server/jobs/job_queue.h"
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

/// The summary of an uploaded scenario as of its check, or an object with an "error".
json uploaded_summary(const ScenarioUpload& upload, const std::string& id) {
  const auto found = std::find(upload.ids.begin(), upload.ids.end(), id);
  const auto index = static_cast<std::size_t>(found - upload.ids.begin());
  if (index < upload.summaries.size()) return upload.summaries[index];
  return {{"error", Problem{id, "", "a scenario that was not there when it was uploaded",
                            "one that can be loaded; upload it again"}
                        .text()}};
}

/// Scenarios as clients see them, in the order of the ids. One that is damaged has an "error" and
/// hides no other. This process loads none: uploaded ones are known from their check.
json scenarios_json(Uploads& uploads, const ConfinedChecks& confined, const ServiceFolders& folders,
                    const std::vector<std::string>& ids) {
  std::vector<std::optional<ScenarioUpload>> uploaded;
  std::vector<std::string> shipped;
  for (const std::string& id : ids) {
    uploaded.push_back(uploads.scenarios().find(upload_name(id)));
    if (!uploaded.back()) shipped.push_back(id);
  }
  const auto summaries = confined.summaries(shipped, folders.scenarios());
  json list = json::array();
  std::size_t next = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto& upload = uploaded[i];
    json value = upload ? uploaded_summary(*upload, ids[i]) : summaries.at(next++);
    value["id"] = ids[i];
    if (value.contains("error")) {
      value["error"] = folders.without_paths(value["error"].get<std::string>());
    } else {
      value["uploaded"] = upload ? upload_json(*upload) : json(nullptr);
    }
    list.push_back(std::move(value));
  }
  return list;
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

void upload_scenarios(Uploads& uploads, const ServiceFolders& folders, const Caller& caller,
                      const Request& request, Response& response) {
  const bool from_blueprint = is_blueprint(request);
  const std::string name = request.get_param_value("name");
  ScenarioStore& store = uploads.scenarios();
  if (is_bundle_name(name)) throw HttpError{409, "names like this are those of jobs' own bundles"};
  if (store.is_taken(name)) {
    throw HttpError{409, fmt::format("there are scenarios named \"{}\" already", name)};
  }
  uploads.require_rate(caller.key_id);
  try {
    ScenarioStore::Staged staged =
        from_blueprint ? store.stage_blueprint(name, parse_json_body(request), caller.key_id)
                       : store.stage(name, request.body, caller.key_id);
    const bool dry = is_asked(request, "dry_run");
    const ScenarioUpload upload = dry ? staged.upload : store.publish(staged);
    json value = upload_json(upload);
    value["ids"] = upload.ids;
    value["findings"] = findings_json(staged.findings);
    if (!dry) response.set_header("Location", "/v1/scenarios/" + upload.ids.front());
    write_json(response, dry ? 200 : 201, value);
  } catch (const InputError& error) {
    throw HttpError{400,
                    from_blueprint ? "no scenario can be made of the blueprint"
                                   : "the bundle cannot be used as it stands",
                    folders.without_paths(error.problems())};
  }
}

void list_scenarios(Uploads& uploads, const ConfinedChecks& confined, const ServiceFolders& folders,
                    AnswerBudget& answers, const Request& request, Response& response) {
  std::vector<std::string> ids = world::list_scenarios(folders.scenarios());
  // Those of one job's bundle are of no use to others.
  std::erase_if(ids, [](const std::string& id) { return is_bundle_name(upload_name(id)); });
  const std::string after = request.get_param_value("after");
  std::sort(ids.begin(), ids.end());
  std::erase_if(ids, [&](const std::string& id) { return !after.empty() && id <= after; });
  ListAnswer answer(answers, "scenarios");
  constexpr std::size_t kAtOnce = 100;  // for each the check of shipped ones is a process
  std::size_t sent = 0;
  while (sent < ids.size() && !answer.is_full()) {
    const std::size_t end = std::min(sent + kAtOnce, ids.size());
    for (const json& value : scenarios_json(
             uploads, confined, folders,
             {ids.begin() + static_cast<long>(sent), ids.begin() + static_cast<long>(end)})) {
      if (answer.is_full()) break;
      answer.add(value);
      ++sent;
    }
  }
  answer.send(response, sent < ids.size() ? ids[sent - 1] : "", {});
}

void send_scenario(Uploads& uploads, const ConfinedChecks& confined, const ServiceFolders& folders,
                   const Request& request, Response& response) {
  const std::string id = request.matches[1];
  const auto all = world::list_scenarios(folders.scenarios());
  if (std::find(all.begin(), all.end(), id) == all.end()) {
    throw HttpError{404, "there is no such scenario; GET /v1/scenarios lists them"};
  }
  const std::string format = request.get_param_value("format");
  if (format == "svg") {
    return response.set_content(confined.scenario_plan(id, folders.scenarios()), "image/svg+xml");
  }
  if (format == "blueprint") {
    const json blueprint = confined.blueprint(id, folders.scenarios());
    if (blueprint.is_null()) throw HttpError{404, "this scenario was not made from a blueprint"};
    return write_json(response, 200, blueprint);
  }
  if (!format.empty() && format != "json") {
    throw HttpError{400, "format is wrong", {{"", "?format", format, "json, svg or blueprint"}}};
  }
  json value = scenarios_json(uploads, confined, folders, {id}).front();
  if (value.contains("error")) {
    throw HttpError{400, "the scenario cannot be loaded", {{"", "", value["error"], ""}}};
  }
  write_json(response, 200, value);
}

void send_job_plan(JobQueue& queue, const ConfinedChecks& confined, const ServiceFolders& folders,
                   const Caller& caller, const Request& request, Response& response) {
  const jobs::JobRow row = find_job(queue, caller, request);
  response.set_content(confined.job_plan(row.spec_json, folders.scenarios()), "image/svg+xml");
}

void remove_scenarios(Uploads& uploads, const Caller& caller, const Request& request,
                      Response& response) {
  const std::string name = request.matches[1];
  const auto upload = uploads.scenarios().find(name);
  if (!upload || is_bundle_name(name)) {
    throw HttpError{404,
                    "there is no such upload; its name is the first part of its scenarios' ids"};
  }
  if (caller.scope < Scope::admin && upload->owner != caller.key_id) {
    throw HttpError{403,
                    "the upload is another's: only its owner and administrators may remove it"};
  }
  if (!uploads.remove(name)) throw HttpError{404, "already removed"};
  response.status = 204;
}

}  // namespace throng::server
