#include "server/api.h"

#include <fmt/core.h>
#include <httplib.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "jobs/archive.h"
#include "jobs/manifest.h"
#include "jobs/spec.h"
#include "server/answers.h"
#include "server/byte_range.h"
#include "server/calibration_api.h"
#include "server/requests.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

void write_problem(Response& response, const HttpError& error) {
  response.status = error.status;
  response.set_content(text_of(problem_document(error.status, error.detail, error.problems)),
                       "application/problem+json");
}

// The paths of the API, the methods each knows, and the pattern it is registered with.
struct Path {
  const char* pattern;
  const char* methods;
};
constexpr const char* kJobs = "/v1/jobs";
constexpr const char* kJob = "/v1/jobs/([a-z0-9]+)";
constexpr const char* kArchive = "/v1/jobs/([a-z0-9]+)/archive";
constexpr const char* kMetrics = "/v1/jobs/([a-z0-9]+)/metrics";
constexpr const char* kRunMetrics = "/v1/jobs/([a-z0-9]+)/runs/([0-9]+)/metrics";
constexpr const char* kRunMetricsCsv = "/v1/jobs/([a-z0-9]+)/runs/([0-9]+)/metrics.csv";
constexpr const char* kCalibrations = "/v1/calibrations";
constexpr const char* kCalibration = "/v1/calibrations/([a-z0-9]+)";
constexpr const char* kCalibrationResult = "/v1/calibrations/([a-z0-9]+)/([a-z0-9]+)";
constexpr const char* kSchema = "/v1/schema";
constexpr const char* kHealth = "/healthz";
constexpr std::array kPaths = {Path{kJobs, "GET, HEAD, POST"},
                               Path{kJob, "GET, HEAD, DELETE"},
                               Path{kArchive, "GET, HEAD"},
                               Path{kMetrics, "GET, HEAD"},
                               Path{kRunMetrics, "GET, HEAD"},
                               Path{kRunMetricsCsv, "GET, HEAD"},
                               Path{kCalibrations, "GET, HEAD, POST"},
                               Path{kCalibration, "GET, HEAD, DELETE"},
                               Path{kCalibrationResult, "GET, HEAD"},
                               Path{kSchema, "GET, HEAD"},
                               Path{kHealth, "GET, HEAD"}};

// Whether the library would find `path` by `pattern`, whose groups are whole segments.
bool fits(std::string_view pattern, std::string_view path) {
  constexpr std::string_view kGroupEnd = "]+)";
  for (std::size_t at = pattern.find('('); at != std::string_view::npos; at = pattern.find('(')) {
    if (!path.starts_with(pattern.substr(0, at))) return false;
    path.remove_prefix(at);
    const std::size_t end = pattern.find(kGroupEnd, at);
    const bool letters = pattern.substr(at, end - at).find("a-z") != std::string_view::npos;
    pattern.remove_prefix(end + kGroupEnd.size());
    const std::string_view segment = path.substr(0, path.find('/'));
    const auto allowed = [&](char c) {
      return ('0' <= c && c <= '9') || (letters && 'a' <= c && c <= 'z');
    };
    if (segment.empty() || !std::all_of(segment.begin(), segment.end(), allowed)) return false;
    path.remove_prefix(segment.size());
  }
  return path == pattern;
}

// The library answers 404 for a method that a path does not know.
void write_library_error(const Request& request, Response& response, int status,
                         const std::string& detail) {
  if (status == 404) {
    for (const Path& path : kPaths) {
      if (!fits(path.pattern, request.path)) continue;
      response.set_header("Allow", path.methods);
      return write_problem(response, {405, fmt::format("{} is not possible here", request.method)});
    }
    return write_problem(response, {404, "there is nothing at this path"});
  }
  write_problem(response, {status, detail});
}

jobs::JobRow find(JobService& service, const Request& request) {
  return find_row(service, request, jobs::JobKind::dataset);
}

jobs::JobRow find_succeeded(JobService& service, const Request& request) {
  jobs::JobRow row = find(service, request);
  if (row.state != jobs::JobState::succeeded) {
    throw HttpError{
        409, fmt::format("the job is {}; this is there once it has succeeded", name_of(row.state))};
  }
  return row;
}

void submit(JobService& service, const Request& request, Response& response) {
  // Also keeps web pages of others from submitting: a browser asks before it sends this type.
  const std::string type = request.get_header_value("Content-Type");
  if (type.substr(0, type.find(';')) != "application/json") {
    throw HttpError{415, "a job is sent with Content-Type: application/json"};
  }
  const jobs::JobRow row = service.submit(request.body);
  response.set_header("Location", fmt::format("{}/{}", kJobs, row.id));
  write_json(response, 201, job_json(row));
}

void list(JobService& service, const Request& request, Response& response) {
  const int limit = limit_of(request);
  const std::vector<jobs::JobRow> rows = service.list(limit, after_of(request));
  json jobs = json::array();
  for (const jobs::JobRow& row : rows) jobs.push_back(job_json(row));
  const bool more = static_cast<int>(rows.size()) == limit;
  write_json(response, 200,
             {{"jobs", std::move(jobs)}, {"next", more ? json(rows.back().id) : json(nullptr)}});
}

// Puts the one range that the client may have into the request, where the library looks for it: it
// would itself answer ranges past the end, several at once, and ignore If-Range.
void settle_range(const Request& request, Response& response, const std::string& etag,
                  std::int64_t size) {
  const RangeAnswer answer = range_answer(request.get_header_value("Range"),
                                          request.get_header_value("If-Range"), etag, size);
  // The library owns the request and made it non-const.
  auto& ranges =
      const_cast<Request&>(request).ranges;  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  ranges.clear();
  if (answer.kind == RangeAnswer::Kind::unsatisfiable) {
    response.set_header("Content-Range", fmt::format("bytes */{}", size));
    throw HttpError{416, fmt::format("the archive has {} bytes", size)};
  }
  if (answer.kind == RangeAnswer::Kind::part) {
    ranges.emplace_back(answer.part.first, answer.part.last);
  }
}

void send_archive(JobService& service, const Request& request, Response& response) {
  const jobs::JobRow row = find_succeeded(service, request);
  const std::filesystem::path dataset = service.dataset_of(row.id);
  const std::string name = jobs::slug(row.name);
  const auto archive = std::make_shared<const jobs::Archive>(dataset, name);
  // The manifest holds the hash of every file.
  const std::string etag = fmt::format("\"{}\"", sha256_hex_of_file(dataset / jobs::kManifestName));
  settle_range(request, response, etag, archive->size());
  response.set_header("ETag", etag);
  response.set_header("Accept-Ranges", "bytes");
  response.set_header("Content-Disposition", fmt::format("attachment; filename=\"{}.tar\"", name));
  response.set_content_provider(
      static_cast<std::size_t>(archive->size()), "application/x-tar",
      [archive, buffer = std::vector<char>(), id = row.id](std::size_t offset, std::size_t length,
                                                           httplib::DataSink& sink) mutable {
        constexpr std::size_t kBlock = 1 << 20;
        buffer.resize(std::min(length, kBlock));
        try {
          const std::size_t count = archive->read(static_cast<std::int64_t>(offset), buffer);
          return sink.write(buffer.data(), count);
        } catch (const EnvironmentError& error) {
          // The length has been promised: all that is left is to break off.
          spdlog::error("archive of job {}: {}", id, error.what());
          return false;
        }
      });
}

void send_metrics(JobService& service, const Request& request, Response& response) {
  const jobs::JobRow row = find_succeeded(service, request);
  response.set_content(read_file(service.dataset_of(row.id) / "metrics.json"), "application/json");
}

// A file of one run of a dataset; 404 when there is no such run or the job did not ask for it.
void send_run_file(JobService& service, const Request& request, Response& response,
                   const char* folder, const char* suffix, const char* type) {
  const jobs::JobRow row = find_succeeded(service, request);
  const std::string number = request.matches[2];
  constexpr std::size_t kMostDigits = 6;
  std::filesystem::path file;
  if (number.size() <= kMostDigits) {
    const std::string name = fmt::format("run{:03}{}", std::stoi(number), suffix);
    file = service.dataset_of(row.id) / folder / name;
  }
  if (file.empty() || !std::filesystem::exists(file)) {
    throw HttpError{404, fmt::format("the dataset has no {} of run {}", folder, number)};
  }
  response.set_content(read_file(file), type);
}

// Runs a handler; turns what it throws into an answer.
template <typename Handler>
void guarded(const JobService& service, const Request& request, Response& response,
             const Handler& handler) {
  try {
    handler();
  } catch (const HttpError& error) {
    write_problem(response, error);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) problem.source = service.without_paths(problem.source);
    write_problem(response, {400, "the job cannot be done as it stands", problems});
  } catch (const std::exception& error) {
    spdlog::error("{} {}: {}", request.method, request.path, error.what());
    write_problem(response, {500, service.without_paths(error.what())});
  }
}

// A page of another site that has its name point here (DNS rebinding) still names itself.
bool names_this_machine(const Request& request) {
  std::string host = request.get_header_value("Host");
  const auto colon = host.rfind(':');
  if (colon != std::string::npos && host.find(']', colon) == std::string::npos) host.resize(colon);
  if (host.size() > 2 && host.front() == '[') host = host.substr(1, host.size() - 2);
  return host.empty() || is_loopback(host);
}

// Pictures of boards are uploaded; everything else is small.
constexpr std::size_t kLargestUpload = 256 << 20;
constexpr std::size_t kLargestText = 1 << 20;

HttpOptions with_uploads(HttpOptions options) {
  options.largest_body = kLargestUpload;
  return options;
}

}  // namespace

Api::Api(JobService& service, const HttpOptions& options)
    : server_(with_uploads(options), &write_library_error) {
  const bool loopback = is_loopback(options.host);
  const auto route = [&service, loopback](void (*handler)(JobService&, const Request&, Response&)) {
    return [&service, loopback, handler](const Request& request, Response& response) {
      guarded(service, request, response, [&] {
        if (loopback && !names_this_machine(request)) {
          throw HttpError{421, "this service is for its own machine"};
        }
        if (request.path != kCalibrations && request.body.size() > kLargestText) {
          throw HttpError{413, fmt::format("a body may have {} bytes here", kLargestText)};
        }
        handler(service, request, response);
      });
    };
  };
  httplib::Server& routes = server_.routes();
  routes.Post(kJobs, route(&submit));
  routes.Get(kJobs, route(&list));
  routes.Get(kJob, route([](JobService& jobs, const Request& request, Response& response) {
               write_json(response, 200, job_json(find(jobs, request)));
             }));
  routes.Delete(kJob, route([](JobService& jobs, const Request& request, Response& response) {
                  if (!jobs.remove(find(jobs, request).id)) throw HttpError{404, "already removed"};
                  response.status = 204;
                }));
  routes.Get(kArchive, route(&send_archive));
  routes.Get(kMetrics, route(&send_metrics));
  routes.Get(kRunMetrics, route([](JobService& jobs, const Request& request, Response& response) {
               send_run_file(jobs, request, response, "metrics", ".json", "application/json");
             }));
  routes.Get(kRunMetricsCsv,
             route([](JobService& jobs, const Request& request, Response& response) {
               send_run_file(jobs, request, response, "exits", ".csv", "text/csv");
             }));
  routes.Post(kCalibrations, route(&submit_calibration));
  routes.Get(kCalibrations, route(&list_calibrations));
  routes.Get(kCalibration, route(&send_calibration));
  routes.Delete(kCalibration, route(&remove_calibration));
  routes.Get(kCalibrationResult, route(&send_calibration_result));
  routes.Get(kSchema, route([](JobService&, const Request&, Response& response) {
               response.set_content(std::string(jobs::job_schema()), "application/schema+json");
             }));
  routes.Get(kHealth, route([](JobService&, const Request&, Response& response) {
               write_json(response, 200, {{"status", "ok"}});
             }));
}

}  // namespace throng::server
