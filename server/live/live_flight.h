// A live flight: its process and its viewers.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "base/compute/steady_time.h"
#include "server/live/kept_messages.h"
#include "server/live/live_flight_spec.h"
#include "server/live/live_process.h"
#include "spec/live/commands.h"
#include "spec/live/messages.h"

namespace throng::server {

/// Viewers of a flight.
struct LiveAudience {
  int viewers = 0;
  SteadyTime last_seen;  ///< when the flight began, a viewer came or left, or the flight ended

  /// Time since then without viewers, by this clock; 0 while there are viewers.
  SteadyTime::duration unseen(const SteadyNow& now) const {
    return viewers > 0 ? SteadyTime::duration::zero() : now() - last_seen;
  }
};

/// Safe to use from many threads.
class LiveFlight {
 public:
  /// Starts the process, which ends with this object. Throws EnvironmentError.
  explicit LiveFlight(LiveFlightSpec spec);

  const LiveFlightSpec& spec() const { return spec_; }
  /// The recording of a flight that is over; it exists as long as this object, if any was begun.
  std::filesystem::path recording() const { return process_.folder() / live::kRecordingFile; }
  LiveProgress progress() const;
  LiveAudience audience() const;

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
    void count(int change);

    std::shared_ptr<LiveFlight> flight_;
    std::uint64_t seen_ = 0;  ///< number of the newest message returned so far
  };

 private:
  void take(const live::Message& message);

  const LiveFlightSpec spec_;
  mutable std::mutex mutex_;  ///< guards messages_, audience_ and process_.send()
  std::condition_variable changed_;
  KeptMessages messages_;
  LiveAudience audience_;
  LiveProcess process_;  ///< last member: passes messages while the others exist
};

}  // namespace throng::server
