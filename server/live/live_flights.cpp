#include "server/live/live_flights.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <utility>

#include "base/files/files.h"
#include "jobs/queue/confine/machine_memory.h"
#include "server/access/random_text.h"
#include "server/catalog/api_json.h"
#include "server/catalog/data_folder.h"
#include "spec/estimates/task_memory.h"
#include "spec/job/spec.h"

namespace throng::server {

namespace {

constexpr std::size_t kFlightIdLength = 16;

/// The memory that a flight needs, which holds the run and draws small images of one camera.
std::int64_t flight_memory_mib(const jobs::ResolvedJob& job) {
  jobs::JobSpec small = job.spec();
  for (jobs::DroneSpec& drone : small.drones) {
    drone.camera = {};
    drone.camera.width = 640;
    drone.camera.height = 360;
  }
  return jobs::TaskMemory(small, job.load()).max_mib();
}

}  // namespace

LiveFlights::LiveFlights(const std::filesystem::path& data, LiveLimits limits)
    : folder_(std::filesystem::absolute(data) / "live"), limits_(std::move(limits)) {
  std::error_code error;
  std::filesystem::remove_all(folder_, error);  // of a service that was killed
  std::filesystem::create_directories(folder_);
  thread_ = std::jthread([this](const std::stop_token& stop) {
    constexpr std::chrono::milliseconds kPause(200);
    std::unique_lock lock(mutex_);
    while (begun_.wait(lock, stop, [this] { return !flights_.empty(); })) {
      if (begun_.wait_for(lock, stop, kPause, [&] { return stop.stop_requested(); })) return;
      lock.unlock();
      end_unseen();
      lock.lock();
    }
  });
}

LiveFlights::~LiveFlights() = default;

void LiveFlights::require_room(const std::string& owner, std::int64_t memory_mib) const {
  std::size_t count = 0;
  std::size_t of_owner = 0;
  for (const auto& [id, flight] : flights_) {
    if (!flight->progress().is_under_way()) continue;
    ++count;
    if (flight->spec().owner == owner) ++of_owner;
  }
  if (of_owner >= limits_.max_per_owner) {
    throw LiveFlightsFull{fmt::format("a key may have {} live flights at once: end one first",
                                      limits_.max_per_owner)};
  }
  if (count >= limits_.max_all) {
    throw LiveFlightsFull{fmt::format("{} live flights are under way; try again later", count)};
  }
  if (jobs::total_memory_mib() > 0 && jobs::available_memory_mib() < memory_mib) {
    throw LiveFlightsFull{"there is not enough free memory for a live flight; try again later"};
  }
}

std::shared_ptr<LiveFlight> LiveFlights::begin(const jobs::ResolvedJob& job,
                                               const std::string& owner, bool is_recorded,
                                               std::int64_t max_recorded_bytes) {
  LiveFlightSpec spec;
  spec.id = "l" + random_text(kFlightIdLength);
  spec.owner = owner;
  spec.name = job.spec().name;
  for (const jobs::DroneSpec& drone : job.spec().drones) {
    spec.drones.push_back({drone.mission.id, !drone.camera.gimbal.is_rigid()});
  }
  spec.job_json = dump_text(to_json(job.spec()));
  spec.memory_mib = flight_memory_mib(job);
  spec.is_recorded = is_recorded;
  spec.max_recorded_bytes = max_recorded_bytes;
  spec.min_free_mib = limits_.min_free_mib;
  spec.folder = folder_;
  spec.command = limits_.command;
  spec.now = limits_.now;
  const std::lock_guard lock(mutex_);
  require_room(owner, spec.memory_mib);
  auto flight = std::make_shared<LiveFlight>(std::move(spec));
  flights_.emplace(flight->spec().id, flight);
  begun_.notify_all();
  spdlog::info("live flight {} begun", flight->spec().id);
  return flight;
}

std::shared_ptr<LiveFlight> LiveFlights::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = flights_.find(id);
  return found == flights_.end() ? nullptr : found->second;
}

std::vector<std::shared_ptr<LiveFlight>> LiveFlights::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<LiveFlight>> all;
  for (const auto& [id, flight] : flights_) all.push_back(flight);
  return all;
}

std::int64_t LiveFlights::disk_bytes_of(const std::string& owner) const {
  std::int64_t bytes = 0;
  for (const std::shared_ptr<LiveFlight>& flight : all()) {
    if (flight->spec().owner != owner) continue;
    bytes += measure_disk_bytes(flight->recording().parent_path());
  }
  return bytes;
}

bool LiveFlights::remove(const std::string& id) {
  std::shared_ptr<LiveFlight> removed;
  {
    const std::lock_guard lock(mutex_);
    const auto found = flights_.find(id);
    if (found == flights_.end()) return false;
    removed = std::move(found->second);
    flights_.erase(found);
  }
  removed->end();
  spdlog::info("live flight {} ended", id);
  return true;
}

int LiveFlights::remove_all_of(const std::set<std::string>& owners) {
  int removed = 0;
  for (const std::shared_ptr<LiveFlight>& flight : all()) {
    if (owners.contains(flight->spec().owner) && remove(flight->spec().id)) ++removed;
  }
  return removed;
}

void LiveFlights::end_unseen() {
  for (const std::shared_ptr<LiveFlight>& flight : all()) {
    const bool is_under_way = flight->progress().is_under_way();
    const auto patience = is_under_way ? limits_.unseen : limits_.ended;
    if (flight->audience().unseen(limits_.now) < patience) continue;
    if (is_under_way) spdlog::info("live flight {}: nobody looks", flight->spec().id);
    remove(flight->spec().id);
  }
}

}  // namespace throng::server
