// All live flights of the service: how many there may be, and those that nobody looks at end.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/compute/steady_time.h"
#include "server/live/live_flight.h"
#include "spec/job/resolved_job.h"

namespace throng::server {

struct LiveLimits {
  std::vector<std::string> command = {"/proc/self/exe", "live"};
  std::size_t max_per_owner = 2;
  std::size_t max_all = 4;
  std::chrono::milliseconds unseen{30'000};  ///< after which a flight ends
  std::chrono::milliseconds ended{600'000};  ///< after which an outcome is forgotten
  std::int64_t max_task_mib = 0;             ///< memory of a flight; 0: any
  SteadyNow now = &steady_now;               ///< by which those times are measured
};

/// There are as many flights as there may be, or there is too little memory.
struct LiveFlightsFull {
  std::string why;
};

/// Safe to use from many threads.
class LiveFlights {
 public:
  /// Folders of flights are made below `data`.
  LiveFlights(const std::filesystem::path& data, LiveLimits limits);
  ~LiveFlights();
  LiveFlights(const LiveFlights&) = delete;
  LiveFlights& operator=(const LiveFlights&) = delete;

  /// Throws LiveFlightsFull and EnvironmentError.
  std::shared_ptr<LiveFlight> begin(const jobs::ResolvedJob& job, const std::string& owner);
  /// Null when there is none.
  std::shared_ptr<LiveFlight> find(const std::string& id) const;
  std::vector<std::shared_ptr<LiveFlight>> all() const;
  /// Ends a flight; false when there is none.
  bool remove(const std::string& id);

 private:
  void require_room(const std::string& owner, std::int64_t memory_mib) const;
  void end_unseen();

  std::filesystem::path folder_;
  LiveLimits limits_;
  mutable std::mutex mutex_;
  std::condition_variable_any begun_;                           ///< a flight
  std::map<std::string, std::shared_ptr<LiveFlight>> flights_;  ///< by id; guarded by mutex_
  std::jthread thread_;
};

}  // namespace throng::server
