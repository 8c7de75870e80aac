#include "live/flight/flight_recording.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/text/redact.h"

namespace throng::live {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A process that is killed loses at most as much.
constexpr std::uint64_t kChunkNs = 1'000'000'000;
constexpr double kLookEveryS = 1;

}  // namespace

FlightRecording::FlightRecording(fs::path file, std::uint64_t min_free_bytes,
                                 std::uint64_t max_bytes)
    : file_(std::move(file)), min_free_bytes_(min_free_bytes), max_bytes_(max_bytes) {
  try {
    formats::McapOptions options;
    options.chunk_ns = kChunkNs;
    recording_ = std::make_unique<formats::ros::Recording>(file_, options);
  } catch (const EnvironmentError& error) {
    keep(error.what());
  }
}

FlightRecording::~FlightRecording() = default;

void FlightRecording::add(const formats::ros::TopicMessage& message) {
  const std::lock_guard lock(mutex_);
  look_at_disk(message.time_s);
  if (recording_) {
    try {
      recording_->add(message);
    } catch (const EnvironmentError& error) {
      keep(error.what());
      release();
    }
  }
  if (!recording_) lost_s_ = std::min(lost_s_.value_or(message.time_s), message.time_s);
}

void FlightRecording::stop(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  close(problem);
}

json FlightRecording::finish() {
  const std::lock_guard lock(mutex_);
  close("");
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(file_, error);
  return {{"complete_until_s", std::min(complete_until_s_, lost_s_.value_or(complete_until_s_))},
          {"problem", problem_.empty() ? json() : json(problem_)},
          {"bytes", error ? 0 : bytes}};
}

// The flight's trace needs space, too, and so do the service's other tasks.
void FlightRecording::look_at_disk(double time_s) {
  if (!recording_ || time_s < next_look_s_) return;
  next_look_s_ = time_s + kLookEveryS;
  std::error_code error;
  if (const auto bytes = fs::file_size(file_, error);
      max_bytes_ > 0 && !error && bytes >= max_bytes_) {
    return close(
        fmt::format("the key's share of the disk is full: the recording has {} bytes, and "
                    "{} were left to it",
                    bytes, max_bytes_));
  }
  const fs::space_info space = fs::space(fs::absolute(file_).parent_path(), error);
  if (error || space.available >= min_free_bytes_) return;
  constexpr int kMibShift = 20;
  close(fmt::format("the disk has less than {} MiB of free space", min_free_bytes_ >> kMibShift));
}

void FlightRecording::close(const std::string& problem) {
  keep(problem);
  if (!recording_) return;
  try {
    recording_->close();
  } catch (const EnvironmentError& error) {
    keep(error.what());
  }
  release();
}

// The file is complete afterwards, also after an error.
void FlightRecording::release() {
  complete_until_s_ = recording_->complete_until_s();
  recording_.reset();
}

void FlightRecording::keep(const std::string& problem) {
  if (problem_.empty()) problem_ = without_folders(problem, {file_.parent_path()});
}

}  // namespace throng::live
