// A live flight: the process that flies it (jobs/live/session.h), and those who look at it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/compute/steady_time.h"
#include "base/files/files.h"
#include "spec/live/commands.h"
#include "spec/live/messages.h"

namespace throng::server {

enum class LiveState { starting, flying, ended, failed };
const char* to_string(LiveState state);

struct LiveFlightSpec {
  std::string id;
  std::string owner;  ///< id of the key
  std::string name;   ///< of the job
  std::vector<std::string> drones;
  std::string job_json;              ///< resolved
  std::int64_t memory_mib = 0;       ///< estimate; 0: not limited
  std::filesystem::path folder;      ///< of all flights; the flight's own is made and removed in it
  std::vector<std::string> command;  ///< the program; the flight's folder is appended
  SteadyNow now = &steady_now;       ///< for the time since somebody has looked
};

/// Safe to use from many threads.
class LiveFlight {
 public:
  /// Starts the process.
  explicit LiveFlight(LiveFlightSpec spec);
  /// Ends it.
  ~LiveFlight();
  LiveFlight(const LiveFlight&) = delete;
  LiveFlight& operator=(const LiveFlight&) = delete;

  const std::string& id() const { return spec_.id; }
  const std::string& owner() const { return spec_.owner; }
  const std::string& name() const { return spec_.name; }
  const std::vector<std::string>& drones() const { return spec_.drones; }
  std::int64_t memory_mib() const { return spec_.memory_mib; }

  LiveState state() const;
  int viewers() const;
  /// Simulated seconds so far.
  double time_s() const;
  /// The result or the failure, once there is one.
  nlohmann::json outcome() const;
  /// How long nobody has looked.
  SteadyTime::duration unseen() const;

  /// False when it has ended.
  bool command(const live::Commands& commands);
  /// Ends the flight and waits for the outcome; false when that takes too long.
  bool stop();
  /// Ends it without an outcome; viewers hear of it.
  void end();

  /// Somebody who looks: gets the messages from the first on, of states and images only the
  /// newest.
  class Viewer {
   public:
    explicit Viewer(std::shared_ptr<LiveFlight> flight);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// All new messages, or after a moment without any a sign of life; "" at the end.
    std::string next();

   private:
    std::shared_ptr<LiveFlight> flight_;
    std::uint64_t seen_ = 0;  ///< number of the newest message that was handed over
  };

 private:
  struct Numbered {
    std::uint64_t number = 0;  ///< 0: none yet
    std::string bytes;         ///< framed
  };

  void run();
  void take(const live::Message& message);
  void fail(const std::string& kind, const std::string& message);
  void send(const nlohmann::json& line);
  void add_viewer(int change);

  LiveFlightSpec spec_;
  StagingFolder folder_;
  int input_read_ = -1;       ///< of the process; until it has started
  mutable std::mutex mutex_;  ///< of all below
  std::condition_variable changed_;
  int input_ = -1;  ///< to the process
  LiveState state_ = LiveState::starting;
  int viewers_ = 0;
  SteadyTime last_seen_;
  double time_s_ = 0;
  std::uint64_t count_ = 0;  ///< of messages
  Numbered hello_;
  Numbered world_;
  Numbered image_;
  std::vector<Numbered> events_;
  Numbered end_;
  nlohmann::json outcome_;
  bool should_end_ = false;
  std::jthread thread_;  ///< that reads from the process
};

}  // namespace throng::server
