// The recording of a live flight, which never ends the flight: it ends itself where it cannot go
// on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "formats/recording/message_sink.h"
#include "formats/recording/recording.h"

namespace throng::live {

/// Safe to use from many threads.
class FlightRecording {
 public:
  /// Begins the file. It ends when the disk has less free space than `min_free_bytes`, or the file
  /// at least `max_bytes` (0: unlimited).
  FlightRecording(std::filesystem::path file, std::uint64_t min_free_bytes,
                  std::uint64_t max_bytes = 0);
  ~FlightRecording();
  FlightRecording(const FlightRecording&) = delete;
  FlightRecording& operator=(const FlightRecording&) = delete;

  /// Adds a message, unless the recording has ended.
  void add(const formats::ros::TopicMessage& message);

  /// Ends the recording because of a problem. The messages until then are kept.
  void stop(const std::string& problem);

  /// Ends the recording; {"complete_until_s": 12.3, "problem": null, "bytes": 123}. All messages
  /// before that time are in the file.
  nlohmann::json finish();

 private:
  void look_at_disk(double time_s);
  void close(const std::string& problem);
  void release();
  void keep(const std::string& problem);

  std::filesystem::path file_;
  std::uint64_t min_free_bytes_;
  std::uint64_t max_bytes_;
  std::mutex mutex_;                                    ///< of all below
  std::unique_ptr<formats::ros::Recording> recording_;  ///< null if it has ended
  double complete_until_s_ = 0;                         ///< of one that has ended
  std::optional<double> lost_s_;  ///< the earliest time of a message that came too late for it
  double next_look_s_ = 0;        ///< at the disk
  std::string problem_;           ///< "": none
};

}  // namespace throng::live
