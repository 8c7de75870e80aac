// The metrics of service_api.h.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "base/text/prometheus.h"
#include "jobs/queue/workers/executor.h"
#include "jobs/queue/workers/task_meters.h"
#include "server/api/service_api.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/uploads.h"
#include "server/http/http.h"
#include "server/http/http_meters.h"
#include "server/jobs/disk_watch.h"
#include "server/jobs/drain.h"
#include "server/jobs/job_queue.h"
#include "server/webhooks/webhook_sender.h"

namespace throng::server {

namespace {

/// Memory in RAM of this process and of all its children, the workers and theirs.
struct ResidentBytes {
  std::int64_t server = 0;
  std::int64_t workers = 0;
};

struct Process {
  int parent = 0;
  std::int64_t resident_pages = 0;
};

/// A process by /proc/PID/stat; nothing once it has ended.
std::optional<Process> read_process(const std::filesystem::path& folder) {
  std::ifstream file(folder / "stat");
  std::string text;
  if (!std::getline(file, text)) return std::nullopt;
  // The name before may hold anything but is in parentheses.
  std::istringstream rest(text.substr(std::min(text.rfind(')') + 1, text.size())));
  constexpr int kParent = 2;  // fields after the name
  constexpr int kResident = 22;
  Process process;
  std::string word;
  for (int field = 1; field <= kResident && rest >> word; ++field) {
    const char* end = word.data() + word.size();
    if (field == kParent) std::from_chars(word.data(), end, process.parent);
    if (field == kResident) std::from_chars(word.data(), end, process.resident_pages);
  }
  return process;
}

ResidentBytes resident_bytes() {
  std::map<int, Process> processes;
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/proc", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (const auto process = read_process(entry->path())) processes[std::stoi(name)] = *process;
  }
  const std::int64_t page_bytes = ::sysconf(_SC_PAGESIZE);
  ResidentBytes bytes{processes[::getpid()].resident_pages * page_bytes, 0};
  std::set<int> ours = {::getpid()};
  for (bool is_found = true; is_found;) {  // children of children
    is_found = false;
    for (const auto& [id, process] : processes) {
      if (ours.contains(id) || !ours.contains(process.parent)) continue;
      ours.insert(id);
      bytes.workers += process.resident_pages * page_bytes;
      is_found = true;
    }
  }
  return bytes;
}

std::string one(const char* name, const char* type, const char* help, double value) {
  return prometheus_head(name, type, help) + prometheus_line(name, "", value);
}

/// Metrics of a cluster's nodes; "" if tasks run on this machine.
std::string node_metrics(const std::vector<jobs::NodeWork>& nodes) {
  if (nodes.empty()) return "";
  std::string running =
      prometheus_head("throng_node_tasks", "gauge", "Tasks that run now, by node.");
  std::string ended = prometheus_head("throng_node_attempts_total", "counter",
                                      "Attempts at tasks that ended since the start, by node.");
  std::string busy =
      prometheus_head("throng_node_busy_seconds_total", "counter", "Time of these attempts.");
  for (const jobs::NodeWork& work : nodes) {
    const auto labels = [&](const char* outcome) {
      return prometheus_labels({{"node", work.node}, {"outcome", outcome}});
    };
    const std::string node = prometheus_labels({{"node", work.node}});
    running += prometheus_line("throng_node_tasks", node, work.running);
    ended += prometheus_line("throng_node_attempts_total", labels("succeeded"), work.done) +
             prometheus_line("throng_node_attempts_total", labels("failed"), work.failed);
    busy += prometheus_line("throng_node_busy_seconds_total", node, work.busy_s);
  }
  return running + ended + busy;
}

std::string job_metrics(const JobQueue& queue) {
  std::string text =
      prometheus_head("throng_jobs", "gauge", "Jobs, calibrations and studies by state.");
  for (const auto& [state, count] : queue.count()) {
    text += prometheus_line("throng_jobs", prometheus_labels({{"state", to_string(state)}}),
                            static_cast<double>(count));
  }
  text += prometheus_head("throng_key_jobs", "gauge",
                          "Queued and running ones by the id of their key; \"other\" is all keys "
                          "but the hundred with the most.");
  constexpr std::size_t kMaxKeys = 100;
  std::set<std::string> keys;
  std::map<std::pair<std::string, jobs::JobState>, std::int64_t> counts;
  for (const jobs::OwnerCount& count : queue.count_by_owner()) {
    const bool is_named = keys.contains(count.owner) || keys.size() < kMaxKeys;
    if (is_named) keys.insert(count.owner);
    counts[{is_named ? count.owner : "other", count.state}] += count.jobs;
  }
  for (const auto& [of, count] : counts) {
    const std::string labels =
        prometheus_labels({{"key", of.first}, {"state", to_string(of.second)}});
    text += prometheus_line("throng_key_jobs", labels, static_cast<double>(count));
  }
  return text + queue.ended_jobs();
}

std::string disk_metrics(JobQueue& queue, Uploads& uploads, const ServiceFolders& folders) {
  const DiskState disk = measure_disk(folders.data());
  constexpr const char* kStored = "throng_stored_bytes";
  std::int64_t upload_bytes = 0;
  for (const ScenarioUpload& upload : uploads.scenarios().list()) upload_bytes += upload.bytes;
  const auto stored = [](const char* what, std::int64_t bytes) {
    return prometheus_line(kStored, prometheus_labels({{"of", what}}), static_cast<double>(bytes));
  };
  return one("throng_disk_free_bytes", "gauge", "Free bytes where the data folder lies.",
             static_cast<double>(disk.free_bytes)) +
         one("throng_disk_total_bytes", "gauge", "Size of that disk.",
             static_cast<double>(disk.total_bytes)) +
         prometheus_head(kStored, "gauge", "Bytes that jobs and uploaded scenarios take.") +
         stored("jobs", queue.total_bytes()) + stored("uploads", upload_bytes);
}

}  // namespace

void send_service_metrics(JobQueue& queue, Uploads& uploads, const ServiceFolders& folders,
                          WebhookSender& hooks, Drain& drain, const jobs::TaskMeters& tasks,
                          const HttpMeters& http, const jobs::Executor& executor,
                          httplib::Response& response) {
  const auto events = static_cast<double>(queue.last_event());
  const ResidentBytes memory = resident_bytes();
  response.set_content(
      job_metrics(queue) +
          one("throng_events_total", "counter", "Events of jobs since the store was made.",
              events) +
          one("throng_event_streams", "gauge", "Clients that watch events.", queue.watchers()) +
          one("throng_queue_paused", "gauge",
              "1 while the queue is paused because the disk is full.",
              queue.paused().empty() ? 0 : 1) +
          one("throng_draining", "gauge", "1 while the service waits for its last tasks.",
              drain.has_begun() ? 1 : 0) +
          tasks.text() + node_metrics(executor.nodes()) + disk_metrics(queue, uploads, folders) +
          one("process_resident_memory_bytes", "gauge", "Memory of the server in RAM.",
              static_cast<double>(memory.server)) +
          one("throng_workers_resident_memory_bytes", "gauge",
              "Memory in RAM of the server's children on this machine.",
              static_cast<double>(memory.workers)) +
          hooks.attempts() + http.text(),
      "text/plain; version=0.0.4; charset=utf-8");
}

}  // namespace throng::server
