// A flight without the service and its page: `throng live`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "spec/job/spec.h"

namespace throng::live {

/// How a job is flown.
struct OutsideOptions {
  double factor = 1;        ///< simulated seconds per second; 0: as fast as it can
  double duration_s = 600;  ///< simulated time at which the flight ends
  bool paused = false;      ///< waits at the start
  bool has_camera = true;   ///< draws images for those who want them
  std::string host = "127.0.0.1";
  std::uint16_t port = 8765;         ///< 0: a free one
  std::vector<std::string> origins;  ///< web pages that may connect besides the usual ones
  std::filesystem::path recording;   ///< MCAP file; "": none
  std::filesystem::path output;      ///< folder for flight000, flight001, ...; "": none
};

/// A flight that is over.
struct Flown {
  double duration_s = 0;
  std::filesystem::path folder;     ///< "": not kept
  std::filesystem::path recording;  ///< "": none
  std::string recording_problem;    ///< why the recording ended before the flight; "": it did not
  std::vector<std::string> warnings;
};

/// News for a user who waits. All are called on the thread of fly_outside().
struct OutsideNews {
  std::function<void(std::uint16_t port)> on_listening;
  std::function<void(double time_s, double reached_factor)> on_step;
  std::function<void(const Flown&)> on_flown;
};

/// Flies the first run of a resolved job, in the scenario of that run, until its time is over, a
/// client ends it or a stop is requested. Throws InputError and EnvironmentError.
void fly_outside(const jobs::JobSpec& job, const std::filesystem::path& scenarios,
                 const OutsideOptions& options, const OutsideNews& news,
                 const std::stop_token& stop);

}  // namespace throng::live
