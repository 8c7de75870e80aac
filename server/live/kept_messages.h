// The messages of a live flight that are kept for viewers who come later, and the flight's progress
// as they tell it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "spec/live/messages.h"

namespace throng::server {

enum class LiveState { starting, flying, ended, failed };
const char* to_string(LiveState state);

/// How far a flight has come.
struct LiveProgress {
  LiveState state = LiveState::starting;
  double time_s = 0;       ///< simulated time so far
  nlohmann::json outcome;  ///< the result or the failure; null while the flight goes on

  bool is_under_way() const { return state == LiveState::starting || state == LiveState::flying; }
};

/// The message that ends a flight without a result.
live::Message failure_message(const std::string& kind, const std::string& text);

/// All messages that matter, of states and images only the newest. Messages are numbered from 1 on.
class KeptMessages {
 public:
  /// Adds a message of the flight's process; no effect after the end. Throws EnvironmentError if an
  /// outcome cannot be read.
  void add(const live::Message& message);
  /// Number of the newest message; 0: none yet.
  std::uint64_t newest() const { return count_; }
  /// The kept messages with higher numbers, framed: the hello first, the end last.
  std::string after(std::uint64_t number) const;
  const LiveProgress& progress() const { return progress_; }
  bool has_ended() const { return !progress_.is_under_way(); }

 private:
  struct Numbered {
    std::uint64_t number = 0;  ///< 0: none yet
    std::string bytes;         ///< framed
  };

  LiveProgress progress_;
  std::uint64_t count_ = 0;  ///< number of messages so far
  Numbered hello_;
  Numbered world_;
  Numbered image_;
  std::vector<Numbered> events_;
  Numbered end_;
};

}  // namespace throng::server
