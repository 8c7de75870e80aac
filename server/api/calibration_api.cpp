#include "server/api/calibration_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/files/files.h"
#include "base/files/untrusted_folders.h"
#include "base/json/json_text.h"
#include "server/access/keys.h"
#include "server/api/requests.h"
#include "server/catalog/api_json.h"
#include "server/catalog/calibrations.h"
#include "server/catalog/service_folders.h"
#include "server/http/answer_budget.h"
#include "server/http/http.h"
#include "server/jobs/housekeeping.h"
#include "server/jobs/job_queue.h"
#include "spec/calibration/request.h"
#include "spec/calibration/request_files.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

struct Result {
  const char* name;
  const char* file;
  const char* type;
};
// Found points are there before, and also when nothing could be estimated from them.
constexpr std::array kResults = {Result{"camera", calibrate::kCameraName, "application/json"},
                                 Result{"opencv", calibrate::kOpenCvName, "application/yaml"},
                                 Result{"ros", calibrate::kRosName, "application/yaml"},
                                 Result{"residuals", calibrate::kPlotName, "image/svg+xml"},
                                 Result{"points", calibrate::kPointsName, "application/json"}};

struct Sent {
  std::string request;
  std::vector<Upload> files;
};

Sent sent_as_form(const Request& request) {
  Sent sent;
  for (const auto& [name, part] : request.files) {
    if (name == "request") {
      sent.request = part.content;
    } else {
      sent.files.push_back({part.filename.empty() ? name : part.filename, part.content});
    }
  }
  if (sent.request.empty()) {
    throw HttpError{400, "there is no part \"request\" with the request as JSON"};
  }
  return sent;
}

Sent sent_as_json(const Request& request) {
  json value = parse_json_body(request);
  Sent sent;
  const json files = value.value("files", json::object());
  for (const auto& [name, text] : files.items()) {
    if (!text.is_string()) {
      throw HttpError{400, "files are wrong", {{"", "/files/" + name, text.dump(), "a text"}}};
    }
    sent.files.push_back({name, text.get<std::string>()});
  }
  value.erase("files");
  sent.request = value.dump();
  return sent;
}

}  // namespace

void submit_calibration(Calibrations& calibrations, Housekeeping& housekeeping,
                        const Caller& caller, const Request& request, Response& response) {
  const std::string header = request.get_header_value("Content-Type");
  const std::string type = header.substr(0, header.find(';'));
  if (type != "application/json" && type != "multipart/form-data") {
    throw HttpError{415, "a calibration is sent as multipart/form-data or application/json"};
  }
  const Sent sent = type == "application/json" ? sent_as_json(request) : sent_as_form(request);
  const jobs::JobRow row = calibrations.submit(
      sent.request, sent.files, {caller.key_id, caller.max_active, caller.max_bytes});
  response.set_header("Location", fmt::format("/v1/calibrations/{}", row.id));
  write_json(response, 201, calibration_json(row, housekeeping.retention()));
}

void list_calibrations(JobQueue& queue, Housekeeping& housekeeping, AnswerBudget& answers,
                       const Caller& caller, const Request& request, Response& response) {
  static const json kSchema = calibrate::request_schema();
  const jobs::JobFilter filter{.kind = jobs::JobKind::calibration,
                               .after = cursor_from_request(request),
                               .limit = requested_limit(request),
                               .visible_to = viewer_key(caller)};
  send_rows(
      queue, answers, response, "calibrations", filter,
      [&](const jobs::JobRow& row) { return calibration_json(row, housekeeping.retention()); },
      {{"schema", kSchema}});
}

void send_calibration(JobQueue& queue, Housekeeping& housekeeping, const ServiceFolders& folders,
                      const Caller& caller, const Request& request, Response& response) {
  const jobs::JobRow row = find_row(queue, caller, request, jobs::JobKind::calibration);
  json value = calibration_json(row, housekeeping.retention());
  if (row.state == jobs::JobState::succeeded) {
    value["camera"] =
        parse_own_json(read_file(folders.calibration_folder(row.id) / calibrate::kCameraName),
                       calibrate::kCameraName);
  }
  write_json(response, 200, value);
}

void remove_calibration(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                        const Request& request, Response& response) {
  const jobs::JobRow row = find_row(queue, caller, request, jobs::JobKind::calibration);
  require_own(caller, row);
  if (!housekeeping.remove(row.id)) {
    throw HttpError{404, "already removed"};
  }
  response.status = 204;
}

void send_calibration_result(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                             const Request& request, Response& response) {
  const jobs::JobRow row = find_row(queue, caller, request, jobs::JobKind::calibration);
  const std::string name = request.matches[2];
  const auto* result = std::find_if(kResults.begin(), kResults.end(),
                                    [&](const Result& entry) { return name == entry.name; });
  if (result == kResults.end()) {
    throw HttpError{404, fmt::format("a calibration has no \"{}\"", name)};
  }
  const std::filesystem::path file = folders.calibration_folder(row.id) / result->file;
  const bool is_early = name == "points" && std::filesystem::exists(file);
  if (row.state != jobs::JobState::succeeded && !is_early) {
    throw HttpError{409, fmt::format("the calibration is {}; this is there once it has succeeded",
                                     to_string(row.state))};
  }
  if (!std::filesystem::exists(file)) {
    throw HttpError{404, "this calibration was made by a version that did not keep this"};
  }
  response.set_content(read_file(file), result->type);
}

void send_calibration_image(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                            const Request& request, Response& response) {
  const jobs::JobRow row = find_row(queue, caller, request, jobs::JobKind::calibration);
  const std::string name = request.matches[2];
  const json images = parse_own_json(row.spec_json, "the request").value("images", json::array());
  const std::filesystem::path file = folders.calibration_folder(row.id) / "files" / name;
  if (std::find(images.begin(), images.end(), json(name)) == images.end() ||
      std::filesystem::path(name).filename() != name || !exists_without_links(file)) {
    throw HttpError{404, "the calibration has no image of this name"};
  }
  const std::string bytes = read_file(file);
  // A file that a browser would take for something else than an image is not sent as one.
  const char* const type = bytes.starts_with("\xff\xd8\xff")        ? "image/jpeg"
                           : bytes.starts_with("\x89PNG\r\n\x1a\n") ? "image/png"
                                                                    : nullptr;
  if (type == nullptr) throw HttpError{404, "this file is neither JPEG nor PNG"};
  response.set_header("Cache-Control", "private, max-age=3600");
  response.set_content(bytes, type);
}

}  // namespace throng::server
