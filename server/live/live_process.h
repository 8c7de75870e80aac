// The process of a live flight (live/flight/session.h), as its service sees it.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <thread>

#include "base/files/files.h"
#include "server/live/live_flight_spec.h"
#include "spec/live/messages.h"

namespace throng::server {

/// Owns the process and its folder. Only send() and end() may be called from many threads, send()
/// from one at a time.
class LiveProcess {
 public:
  using OnMessage = std::function<void(const live::Message&)>;

  /// Starts the process. A thread of this object passes its messages to `on_message`, and a failure
  /// if it cannot be run or ends without an outcome. `spec` must outlive this object. Throws
  /// EnvironmentError.
  LiveProcess(const LiveFlightSpec& spec, OnMessage on_message);
  /// Ends the process.
  ~LiveProcess();
  LiveProcess(const LiveProcess&) = delete;
  LiveProcess& operator=(const LiveProcess&) = delete;

  /// Its folder, which exists as long as this object.
  const std::filesystem::path& folder() const { return folder_.path(); }
  /// Writes a line to its stdin; never blocks.
  void send(const nlohmann::json& line);
  /// Ends the process soon, without a further message.
  void end() { thread_.request_stop(); }

 private:
  void run(const std::stop_token& stop);
  bool pass_messages(int output, const std::stop_token& stop);

  const LiveFlightSpec& spec_;
  OnMessage on_message_;
  StagingFolder folder_;
  int input_read_ = -1;  ///< read end of its stdin; open until it has started
  int input_ = -1;       ///< write end of its stdin
  std::jthread thread_;  ///< reads from the process
};

}  // namespace throng::server
