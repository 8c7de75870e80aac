#include "server/api/live_api.h"

#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text/slug.h"
#include "server/access/keys.h"
#include "server/api/requests.h"
#include "server/catalog/api_json.h"
#include "server/http/file_answer.h"
#include "server/http/http.h"
#include "server/jobs/job_queue.h"
#include "server/live/live_flights.h"
#include "spec/job/scenario_mix.h"
#include "spec/live/commands.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

bool is_own(const Caller& caller, const LiveFlight& flight) {
  return sees_all(caller) || flight.spec().owner == caller.key_id;
}

/// The caller's flight that the path names. Throws HttpError 404.
std::shared_ptr<LiveFlight> find_flight(LiveFlights& live, const Caller& caller,
                                        const Request& request) {
  const std::string id = request.matches[1];
  std::shared_ptr<LiveFlight> flight = live.find(id);
  if (!flight || !is_own(caller, *flight)) {
    throw HttpError{404, fmt::format("there is no live flight {}", id)};
  }
  return flight;
}

json flight_json(const LiveFlight& flight) {
  const LiveFlightSpec& spec = flight.spec();
  const LiveProgress progress = flight.progress();
  const std::string self = "/v1/live/" + spec.id;
  json drones = json::array();
  for (const live::FlownDrone& drone : spec.drones) drones.push_back(drone.id);
  json value = {{"id", spec.id},
                {"name", spec.name},
                {"state", to_string(progress.state)},
                {"time_s", progress.time_s},
                {"viewers", flight.audience().viewers},
                {"drones", std::move(drones)},
                {"recorded", spec.is_recorded},
                {"result", nullptr},
                {"error", nullptr},
                {"links",
                 {{"self", self},
                  {"stream", self + "/stream"},
                  {"recording", spec.is_recorded ? json(self + "/recording") : json()}}}};
  const json& outcome = progress.outcome;
  if (progress.state == LiveState::ended) value["result"] = outcome;
  if (progress.state == LiveState::failed) {
    value["error"] = error_json(outcome.at("kind"), outcome.at("message"), {});
  }
  return value;
}

/// The problems of a part of what was sent.
std::vector<Problem> problems_below(std::vector<Problem> problems, const std::string& pointer) {
  for (Problem& problem : problems) {
    if (problem.source.empty()) problem.where = pointer + problem.where;
  }
  return problems;
}

jobs::ResolvedJob job_in(JobQueue& queue, const Caller& caller, const json& body) {
  const auto job = body.find("job");
  if (job == body.end() || !job->is_object()) {
    throw wrong_field("request", "/job", job == body.end() ? "nothing" : job->dump().substr(0, 60),
                      "a job");
  }
  try {
    jobs::ResolvedJob resolved = queue.resolve(*job, viewer_key(caller));
    // A flight takes place in one scenario: that of the job's first run.
    if (!resolved.spec().drones.empty()) {
      return jobs::ResolvedJob(jobs::in_scenario_of_run(resolved.spec(), 0), resolved.load());
    }
  } catch (const InputError& error) {
    throw HttpError{400, "the job cannot be done as it stands",
                    problems_below(error.problems(), "/job")};
  }
  throw wrong_field("request", "/job/drones", "no drone", "at least one drone to fly");
}

bool is_to_be_recorded(const json& body) {
  const auto record = body.find("record");
  if (record == body.end()) return false;
  if (record->is_boolean()) return record->get<bool>();
  throw wrong_field("request", "/record", record->dump().substr(0, 60), "true or false");
}

/// Bytes that the caller's key leaves to a recording; 0: unlimited. Throws QuotaError.
std::int64_t left_to_recording(JobQueue& queue, const Caller& caller) {
  if (caller.max_bytes <= 0) return 0;
  const std::int64_t used = queue.bytes_of(caller.key_id);
  if (used < caller.max_bytes) return caller.max_bytes - used;
  throw QuotaError(fmt::format(
      "your jobs take {} bytes of disk, and this key may have {} beside its live flights: remove "
      "some, or fly without a recording",
      used, caller.max_bytes));
}

}  // namespace

void begin_live(JobQueue& queue, LiveFlights& live, const Caller& caller, const Request& request,
                Response& response) {
  const json body = json_fields(request, "request", {"job", "record"});
  const bool is_recorded = is_to_be_recorded(body);
  const jobs::ResolvedJob job = job_in(queue, caller, body);
  try {
    const std::int64_t max_bytes = is_recorded ? left_to_recording(queue, caller) : 0;
    const auto flight = live.begin(job, caller.key_id, is_recorded, max_bytes);
    response.set_header("Location", "/v1/live/" + flight->spec().id);
    write_json(response, 201, flight_json(*flight));
  } catch (const LiveFlightsFull& full) {
    response.set_header("Retry-After", "10");
    throw HttpError{503, full.why};
  }
}

void list_live(LiveFlights& live, const Caller& caller, Response& response) {
  json list = json::array();
  for (const auto& flight : live.all()) {
    if (!is_own(caller, *flight)) continue;
    json value = flight_json(*flight);
    value.erase("result");
    list.push_back(std::move(value));
  }
  response.set_header("Cache-Control", "no-store");
  write_json(response, 200, {{"flights", std::move(list)}});
}

void send_live(LiveFlights& live, const Caller& caller, const Request& request,
               Response& response) {
  response.set_header("Cache-Control", "no-store");
  write_json(response, 200, flight_json(*find_flight(live, caller, request)));
}

void stream_live(LiveFlights& live, Keys& keys, const Caller& caller, const Request& request,
                 Response& response) {
  const std::shared_ptr<LiveFlight> flight = find_flight(live, caller, request);
  const std::shared_ptr<void> held = live.begin_view(caller.key_id);
  if (held == nullptr) {
    throw HttpError{429, fmt::format("this key may watch live flights {} times at once, and all "
                                     "keys together {}: close some streams",
                                     kMaxViewersOfKey, kMaxViewers)};
  }
  const auto viewer = std::make_shared<LiveFlight::Viewer>(flight);
  response.set_header("Cache-Control", "no-store");
  response.set_header("X-Accel-Buffering", "no");  // nginx would hold messages back
  response.set_chunked_content_provider(
      "application/octet-stream", [viewer, held, &keys = keys, caller = caller,
                                   next_check = std::chrono::steady_clock::time_point()](
                                      std::size_t, httplib::DataSink& sink) mutable {
        const std::string bytes = viewer->next();
        const auto now = std::chrono::steady_clock::now();
        bool may_go_on = !bytes.empty();
        if (may_go_on && now >= next_check) {
          may_go_on = keys.is_valid(caller);  // it may have been revoked since
          next_check = now + std::chrono::seconds(1);
        }
        if (!may_go_on) {
          sink.done();
          return true;
        }
        return sink.write(bytes.data(), bytes.size());
      });
}

void command_live(LiveFlights& live, const Caller& caller, const Request& request,
                  Response& response) {
  require_json(request);
  const std::shared_ptr<LiveFlight> flight = find_flight(live, caller, request);
  const json body = parse_json_body(request);
  live::Commands commands;
  try {
    commands = live::commands_from_json(body, flight->spec().drones);
  } catch (const InputError& error) {
    throw HttpError{400, "the commands are wrong", error.problems()};
  }
  if (!flight->command(commands)) throw HttpError{409, "the flight has ended"};
  response.status = 204;
}

void stop_live(LiveFlights& live, const Caller& caller, const Request& request,
               Response& response) {
  const std::shared_ptr<LiveFlight> flight = find_flight(live, caller, request);
  const LiveProgress progress = flight->progress();
  if (progress.state != LiveState::failed && progress.time_s <= 0) {
    throw HttpError{409, "the flight has not begun: nobody has looked at it yet"};
  }
  if (!flight->stop()) throw HttpError{503, "the flight does not answer; try again"};
  write_json(response, 200, flight_json(*flight));
}

void send_live_recording(LiveFlights& live, const Caller& caller, const Request& request,
                         Response& response) {
  const std::shared_ptr<LiveFlight> flight = find_flight(live, caller, request);
  if (!flight->spec().is_recorded) {
    throw HttpError{404, "the flight was not recorded: it was begun without \"record\": true"};
  }
  if (flight->progress().is_under_way()) {
    throw HttpError{409, "the flight goes on; its recording is there when it has ended"};
  }
  if (!std::filesystem::exists(flight->recording())) {
    throw HttpError{404, "nothing was recorded; the flight's result says why"};
  }
  response.set_header("Content-Disposition",
                      fmt::format("attachment; filename=\"{}.mcap\"", slug(flight->spec().name)));
  answer_with_file(request, response, flight->recording(), "application/octet-stream",
                   fmt::format("\"{}\"", flight->spec().id));
}

void remove_live(LiveFlights& live, const Caller& caller, const Request& request,
                 Response& response) {
  if (!live.remove(find_flight(live, caller, request)->spec().id))
    throw HttpError{404, "already removed"};
  response.status = 204;
}

}  // namespace throng::server
