// A live flight: its process (jobs/live/session.h) and its viewers.
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

/// Parameters of a flight.
struct LiveFlightSpec {
  std::string id;
  std::string owner;  ///< id of the key
  std::string name;   ///< name of the job
  std::vector<live::FlownDrone> drones;
  std::string job_json;          ///< the resolved job
  std::int64_t memory_mib = 0;   ///< estimated memory; 0: not limited
  bool is_recorded = false;      ///< whether it is asked to record itself
  std::filesystem::path folder;  ///< folder in which the flight's temporary folder is created
  std::int64_t max_recorded_bytes = 0;  ///< a recording ends at this size; 0: unlimited
  std::int64_t min_free_mib = 0;        ///< a recording ends when the disk has less free space
  std::vector<std::string> command;  ///< the program; the flight's folder and options are appended
  SteadyNow now = &steady_now;       ///< clock of unseen()
};

/// Safe to use from many threads.
class LiveFlight {
 public:
  /// Starts the process.
  explicit LiveFlight(LiveFlightSpec spec);
  /// Ends the process.
  ~LiveFlight();
  LiveFlight(const LiveFlight&) = delete;
  LiveFlight& operator=(const LiveFlight&) = delete;

  const std::string& id() const { return spec_.id; }
  const std::string& owner() const { return spec_.owner; }
  const std::string& name() const { return spec_.name; }
  const std::vector<live::FlownDrone>& drones() const { return spec_.drones; }
  std::int64_t memory_mib() const { return spec_.memory_mib; }
  bool is_recorded() const { return spec_.is_recorded; }
  /// The recording of a flight that is over; it exists as long as this object, if any was begun.
  std::filesystem::path recording() const { return folder_.path() / live::kRecordingFile; }

  LiveState state() const;
  int viewers() const;
  /// Simulated time so far.
  double time_s() const;
  /// The result or the failure; null while the flight goes on.
  nlohmann::json outcome() const;
  /// Time since the last viewer left; 0 while there are viewers.
  SteadyTime::duration unseen() const;

  /// Sends commands to the flight; returns false if it has ended.
  bool command(const live::Commands& commands);
  /// Ends the flight and waits for the outcome; returns false if that takes too long.
  bool stop();
  /// Ends the flight without an outcome and informs the viewers.
  void end();

  /// A viewer receives all messages from the first on, but only the newest state and image.
  class Viewer {
   public:
    explicit Viewer(std::shared_ptr<LiveFlight> flight);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// Blocks for new messages and returns all of them, or a sign of life if there are none for a
    /// while; "" at the end.
    std::string next();

   private:
    std::shared_ptr<LiveFlight> flight_;
    std::uint64_t seen_ = 0;  ///< number of the newest message returned so far
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
  int input_read_ = -1;       ///< read end of the process's stdin; open until it has started
  mutable std::mutex mutex_;  ///< guards all members below
  std::condition_variable changed_;
  int input_ = -1;  ///< write end of the process's stdin
  LiveState state_ = LiveState::starting;
  int viewers_ = 0;
  SteadyTime last_seen_;
  double time_s_ = 0;
  std::uint64_t count_ = 0;  ///< number of messages so far
  Numbered hello_;
  Numbered world_;
  Numbered image_;
  std::vector<Numbered> events_;
  Numbered end_;
  nlohmann::json outcome_;
  bool should_end_ = false;
  std::jthread thread_;  ///< reads from the process
};

}  // namespace throng::server
