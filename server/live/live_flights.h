// All live flights of the service. Limits their number and ends flights without viewers.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/compute/steady_time.h"
#include "server/http/key_limit.h"
#include "server/live/live_flight.h"
#include "spec/job/resolved_job.h"

namespace throng::server {

/// Each viewer holds a thread of the server.
inline constexpr int kMaxViewers = 64;
inline constexpr int kMaxViewersOfKey = 8;

/// Limits on live flights.
struct LiveLimits {
  std::vector<std::string> command = {"/proc/self/exe", "live-process"};  ///< a flight's
  std::size_t max_per_owner = 2;
  std::size_t max_all = 4;
  std::chrono::milliseconds unseen{30'000};  ///< time without viewers until a flight ends
  std::chrono::milliseconds ended{600'000};  ///< time for which an outcome is kept
  std::int64_t max_task_mib = 0;             ///< max memory of a flight; 0: unlimited
  std::int64_t min_free_mib = 512;           ///< recordings end when the disk has less free space
  SteadyNow now = &steady_now;               ///< clock of these times
};

/// Thrown if the limits on flights are reached or memory is short.
struct LiveFlightsFull {
  std::string why;
};

/// Safe to use from many threads.
class LiveFlights {
 public:
  /// Creates the folders of flights below `data`.
  LiveFlights(const std::filesystem::path& data, LiveLimits limits);
  ~LiveFlights();
  LiveFlights(const LiveFlights&) = delete;
  LiveFlights& operator=(const LiveFlights&) = delete;

  /// Starts a flight, which records itself if asked to: at most `max_recorded_bytes`, unless that
  /// is 0. Throws LiveFlightsFull and EnvironmentError.
  std::shared_ptr<LiveFlight> begin(const jobs::ResolvedJob& job, const std::string& owner,
                                    bool is_recorded = false, std::int64_t max_recorded_bytes = 0);
  /// Disk usage of an owner's flights, which counts for their quota as long as the flights are
  /// kept.
  std::int64_t disk_bytes_of(const std::string& owner) const;
  /// The flight with this id; null if there is none.
  std::shared_ptr<LiveFlight> find(const std::string& id) const;
  std::vector<std::shared_ptr<LiveFlight>> all() const;
  /// Registers a viewer of any flight for the lifetime of the result; null if all keys together, or
  /// this key, have as many as they may.
  std::shared_ptr<void> begin_view(const std::string& key) { return viewers_.hold(key); }
  /// Ends and removes a flight; returns false if there is none.
  bool remove(const std::string& id);
  /// Ends and removes all flights of these owners. Returns their number.
  int remove_all_of(const std::set<std::string>& owners);

 private:
  void require_room(const std::string& owner, std::int64_t memory_mib) const;
  void end_unseen();

  std::filesystem::path folder_;
  LiveLimits limits_;
  KeyLimit viewers_{kMaxViewersOfKey, kMaxViewers};
  mutable std::mutex mutex_;
  std::condition_variable_any begun_;                           ///< a flight was started
  std::map<std::string, std::shared_ptr<LiveFlight>> flights_;  ///< by id; guarded by mutex_
  std::jthread thread_;
};

}  // namespace throng::server
