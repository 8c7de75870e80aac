#include "server/api/events_api.h"

#include <fmt/core.h>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "server/access/keys.h"
#include "server/api/downloads_api.h"
#include "server/api/requests.h"
#include "server/catalog/api_json.h"
#include "server/catalog/service_folders.h"
#include "server/http/http.h"
#include "server/jobs/job_queue.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;
using namespace std::chrono_literals;

namespace {

constexpr auto kBeat = 500ms;  // how often a stream looks for progress, and for its end
constexpr auto kKeepAlive = 10s;
constexpr auto kPreviewPause = 2s;
constexpr std::int64_t kLastNumber = std::numeric_limits<std::int64_t>::max();

/// Drops events of jobs that the caller does not see. Nobody but administrators learns of the
/// removal of a job.
std::vector<jobs::EventRow> visible(std::vector<jobs::EventRow> events, const JobQueue& queue,
                                    const Caller& caller) {
  if (sees_all(caller)) return events;
  std::map<std::string, bool> known;
  std::erase_if(events, [&](const jobs::EventRow& event) {
    auto found = known.find(event.job);
    if (found == known.end()) {
      const auto row = queue.get(event.job);
      found = known.emplace(event.job, row && is_visible(caller, *row)).first;
    }
    return !found->second;
  });
  return events;
}

/// Throws HttpError 429.
std::shared_ptr<void> watch_for(JobQueue& queue, const Caller& caller) {
  std::shared_ptr<void> watch = queue.begin_watch(caller.key_id);
  if (watch != nullptr) return watch;
  throw HttpError{
      429, fmt::format("this key may have {} event streams and requests that wait for events, and "
                       "all keys together {}: close some, or ask without ?wait_s=",
                       kMaxWatchersOfKey, kMaxWatchers)};
}

class EventStream {
 public:
  /// `folder`: of the job, where its previews are looked for; empty: nowhere.
  EventStream(JobQueue& queue, const Keys& keys, Caller caller, std::string job, std::int64_t after,
              std::filesystem::path folder)
      : watch_(watch_for(queue, caller)),
        queue_(queue),
        keys_(keys),
        folder_(std::move(folder)),
        caller_(std::move(caller)),
        job_(std::move(job)),
        after_(after) {}

  /// Writes what there is, or waits a moment for it; false when the client has gone. Past events
  /// come first, in order; progress and previews follow the events that were there before them, and
  /// none follows the end.
  bool step(httplib::DataSink& sink) {
    // Looked at before the events: what ends the job is among them.
    const auto row = job_.empty() ? std::nullopt : queue_.get(job_);
    // The key may have been revoked since, or the job be shared no more.
    if (!keys_.is_valid(caller_) || (row && !is_visible(caller_, *row))) {
      sink.done();
      return true;
    }
    const bool may_go_on = job_.empty() || (row && is_active(row->state));
    const auto events = queue_.events(job_, after_, kMaxEventsOfPage, 0ms);
    if (!events.empty()) after_ = events.back().seq;
    std::string text;
    for (const jobs::EventRow& event : visible(events, queue_, caller_)) {
      text += fmt::format("id: {}\nevent: {}\ndata: {}\n\n", event.seq, event.type,
                          dump_text(event_json(event)));
    }
    const bool is_past_complete = static_cast<int>(events.size()) < kMaxEventsOfPage;
    if (is_past_complete && row && row->state == jobs::JobState::running) text += news_of(*row);
    const auto now = std::chrono::steady_clock::now();
    if (text.empty() && now - last_write_ > kKeepAlive) text = ": still here\n\n";
    if (!text.empty()) {
      last_write_ = now;
      if (!sink.write(text.data(), text.size())) return false;
    }
    if (!events.empty()) return true;
    if (may_go_on) {
      queue_.events(job_, after_, 1, kBeat);  // they are read with the next step
    } else {
      sink.done();
    }
    return true;
  }

 private:
  /// Progress and preview of a job that was running before the events were read, as far as they are
  /// new; none if it has gone on since: the events that were read may hold its end.
  std::string news_of(const jobs::JobRow& row) {
    std::string text;
    const std::string progress = row.progress_json == progress_ ? "" : row.progress_json;
    if (!progress.empty()) text += fmt::format("event: progress\ndata: {}\n\n", progress);
    const auto now = std::chrono::steady_clock::now();
    const bool looks = !folder_.empty() && now - last_look_ > kPreviewPause;
    const std::string preview = looks ? newest_preview(folder_) : "";
    if (!preview.empty() && preview != preview_) text += preview_event(preview);
    if (!text.empty()) {
      const auto later = queue_.get(job_);
      if (!later || later->state != row.state || later->attempt != row.attempt) return {};
    }
    progress_ = row.progress_json;
    if (looks) last_look_ = now;
    if (!preview.empty()) preview_ = preview;
    return text;
  }

  std::string preview_event(const std::string& name) const {
    return fmt::format(
        "event: preview\ndata: {}\n\n",
        dump_text({{"name", name}, {"href", fmt::format("/v1/jobs/{}/previews/{}", job_, name)}}));
  }

  std::shared_ptr<void> watch_;
  const JobQueue& queue_;
  const Keys& keys_;
  std::filesystem::path folder_;
  std::string preview_;
  std::chrono::steady_clock::time_point last_look_;
  Caller caller_;
  std::string job_;
  std::int64_t after_;
  std::string progress_;
  std::chrono::steady_clock::time_point last_write_ = std::chrono::steady_clock::now();
};

std::int64_t last_event_id(const Request& request) {
  const std::string text = request.get_header_value("Last-Event-ID");
  if (text.empty()) return requested_number(request, "after", 0, kLastNumber, 0);
  std::int64_t number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || number < 0) {
    throw HttpError{
        400, "Last-Event-ID is wrong", {{"", "Last-Event-ID", text, "the number of an event"}}};
  }
  return number;
}

void send_page(JobQueue& queue, Keys& keys, const Caller& caller, const Request& request,
               Response& response, const std::string& job) {
  const std::int64_t after = requested_number(request, "after", 0, kLastNumber, 0);
  const auto limit =
      static_cast<int>(requested_number(request, "limit", 1, kMaxEventsOfPage, kMaxEventsOfPage));
  const std::chrono::seconds timeout(requested_number(request, "wait_s", 0, kMaxEventWaitS, 0));
  json list = json::array();
  const auto watch = timeout.count() > 0 ? watch_for(queue, caller) : nullptr;
  const std::vector<jobs::EventRow> events = queue.events(job, after, limit, timeout);
  const std::int64_t next = events.empty() ? after : events.back().seq;
  if (!keys.is_valid(caller)) {
    throw HttpError{401, "this key is not known, or was revoked"};
  }
  for (const jobs::EventRow& event : visible(events, queue, caller)) {
    list.push_back(event_json(event));
  }
  write_json(response, 200, {{"events", std::move(list)}, {"next", next}});
}

/// Sends the events of the job or study with this id; "" for all.
void send_job_events(JobQueue& queue, Keys& keys, const Caller& caller, const Request& request,
                     Response& response, const std::string& job,
                     const std::filesystem::path& folder) {
  if (request.get_header_value("Accept").find("text/event-stream") == std::string::npos) {
    return send_page(queue, keys, caller, request, response, job);
  }
  const auto stream =
      std::make_shared<EventStream>(queue, keys, caller, job, last_event_id(request), folder);
  response.set_header("Cache-Control", "no-store");
  response.set_header("X-Accel-Buffering", "no");  // nginx would hold events back
  response.set_chunked_content_provider(
      "text/event-stream",
      [stream](std::size_t, httplib::DataSink& sink) { return stream->step(sink); });
}

}  // namespace

void send_events(JobQueue& queue, const ServiceFolders& folders, Keys& keys, const Caller& caller,
                 const Request& request, Response& response) {
  if (request.matches.size() < 2)
    return send_job_events(queue, keys, caller, request, response, "", {});
  const std::string id = find_job(queue, caller, request).id;
  send_job_events(queue, keys, caller, request, response, id, folders.job_folder(id));
}

void send_study_events(JobQueue& queue, Keys& keys, const Caller& caller, const Request& request,
                       Response& response) {
  send_job_events(queue, keys, caller, request, response,
                  find_row(queue, caller, request, jobs::JobKind::study).id, {});
}

}  // namespace throng::server
