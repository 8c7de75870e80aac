#include "server/api/studies_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "server/access/keys.h"
#include "server/api/requests.h"
#include "server/api/row_changes.h"
#include "server/catalog/api_json.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/studies.h"
#include "server/http/answer_budget.h"
#include "server/http/file_answer.h"
#include "server/http/http.h"
#include "server/jobs/housekeeping.h"
#include "server/jobs/job_queue.h"
#include "spec/study/study_files.h"

namespace throng::server {

namespace fs = std::filesystem;
using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

struct Result {
  const char* name;
  const char* type;
  bool is_early;  ///< there while the study runs, too
};
constexpr std::array kResults = {Result{study::kSummaryName, "application/json", false},
                                 Result{study::kCsvName, "text/csv", false},
                                 Result{study::kMarkdownName, "text/markdown", false},
                                 Result{study::kValuesName, "application/json", true}};

jobs::JobRow find_study(JobQueue& queue, const Caller& caller, const Request& request) {
  return find_row(queue, caller, request, jobs::JobKind::study);
}

jobs::JobRow find_own_study(JobQueue& queue, const Caller& caller, const Request& request) {
  jobs::JobRow row = find_study(queue, caller, request);
  require_own(caller, row);
  return row;
}

HttpError not_there_yet(const jobs::JobRow& row) {
  return {409, fmt::format("the study is {}; this is there once it has succeeded",
                           to_string(row.state))};
}

/// The result of a run that the path names, made again from the plan's ids: none leads elsewhere.
std::optional<fs::path> run_file(const json& plan, const std::string& path) {
  for (const json& one : plan.at("cases")) {
    for (const json& policy : plan.at("policies")) {
      const std::string folder =
          study::result_file(one.at("id"), policy.at("id"), 0).parent_path().string() + "/";
      if (!path.starts_with(folder)) continue;
      const std::string_view number = std::string_view(path).substr(folder.size());
      int run = -1;
      std::from_chars(number.data(), number.data() + number.size(), run);
      const fs::path file = study::result_file(one.at("id"), policy.at("id"), std::max(run, 0));
      if (run >= 0 && file.string() == path) return file;
    }
  }
  return std::nullopt;
}

void answer_with(const Request& request, Response& response, const fs::path& file,
                 const char* type) {
  answer_with_file(request, response, file, type, fmt::format("\"{}\"", sha256_hex_of_file(file)));
}

}  // namespace

void submit_study(Studies& studies, Housekeeping& housekeeping, const Caller& caller,
                  const Request& request, Response& response) {
  require_json(request);
  const json document = parse_json_body(request);
  if (is_asked(request, "dry_run")) {
    json plan = studies.checked(document);
    plan["valid"] = true;
    return write_json(response, 200, plan);
  }
  const jobs::JobRow row =
      studies.submit(document, {caller.key_id, caller.max_active, caller.max_bytes});
  response.set_header("Location", "/v1/studies/" + row.id);
  write_json(response, 201, study_json(row, housekeeping.retention()));
}

void list_studies(JobQueue& queue, Housekeeping& housekeeping, AnswerBudget& answers,
                  const Caller& caller, const Request& request, Response& response) {
  const jobs::JobFilter filter{.kind = jobs::JobKind::study,
                               .after = cursor_from_request(request),
                               .limit = requested_limit(request),
                               .visible_to = viewer_key(caller),
                               .with_spec = false};
  send_rows(queue, answers, response, "studies", filter,
            [&](const jobs::JobRow& row) { return study_json(row, housekeeping.retention()); });
}

void send_study(JobQueue& queue, Studies& studies, Housekeeping& housekeeping, const Caller& caller,
                const Request& request, Response& response) {
  const jobs::JobRow row = find_study(queue, caller, request);
  json value = study_json(row, housekeeping.retention());
  value["plan"] = studies.plan_of(row);
  value["summary"] = studies.summarize(row);
  write_json(response, 200, value);
}

void change_study(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                  const Request& request, Response& response) {
  const jobs::JobRow own = find_own_study(queue, caller, request);
  const auto row = queue.change(own.id, read_change(caller, request, own));
  if (!row) throw HttpError{404, "the study has been removed"};
  write_json(response, 200, study_json(*row, housekeeping.retention()));
}

void cancel_study(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                  const Request& request, Response& response) {
  const auto row = queue.cancel(find_own_study(queue, caller, request).id);
  if (!row) throw HttpError{404, "the study has been removed"};
  write_json(response, 200, study_json(*row, housekeeping.retention()));
}

void retry_study(JobQueue& queue, Housekeeping& housekeeping, Keys& keys, const Caller& caller,
                 const Request& request, Response& response) {
  const jobs::JobRow row = retried(queue, keys, caller, find_own_study(queue, caller, request));
  write_json(response, 200, study_json(row, housekeeping.retention()));
}

void remove_study(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                  const Request& request, Response& response) {
  if (!housekeeping.remove(find_own_study(queue, caller, request).id)) {
    throw HttpError{404, "already removed"};
  }
  response.status = 204;
}

void send_study_report(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                       const Request& request, Response& response) {
  const jobs::JobRow row = find_study(queue, caller, request);
  if (row.state != jobs::JobState::succeeded) throw not_there_yet(row);
  answer_with(request, response, folders.ground_truth_folder(row) / study::kReportName,
              "text/html; charset=utf-8");
}

void send_study_file(JobQueue& queue, Studies& studies, const ServiceFolders& folders,
                     const Caller& caller, const Request& request, Response& response) {
  const jobs::JobRow row = find_study(queue, caller, request);
  const fs::path folder = folders.ground_truth_folder(row);
  const std::string wanted = request.matches[2];
  const auto* result = std::find_if(kResults.begin(), kResults.end(),
                                    [&](const Result& entry) { return wanted == entry.name; });
  const bool is_result = result != kResults.end();
  const auto run = is_result ? std::nullopt : run_file(studies.plan_of(row), wanted);
  if (!is_result && !run) {
    throw HttpError{404,
                    "a study has summary.json, summary.csv, summary.md, values.json and "
                    "runs/CASE/POLICY/000.json"};
  }
  const fs::path file = folder / (is_result ? fs::path(wanted) : *run);
  const bool is_early = !is_result || result->is_early;
  if (!is_early && row.state != jobs::JobState::succeeded) throw not_there_yet(row);
  if (!fs::exists(file)) {
    throw HttpError{409,
                    fmt::format("the study is {}; this is not there yet", to_string(row.state))};
  }
  answer_with(request, response, file, is_result ? result->type : "application/json");
}

}  // namespace throng::server
