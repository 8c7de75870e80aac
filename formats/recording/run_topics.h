// Topics of a run that belong to no drone: the clock, and people as boxes.
#pragma once

#include <string>
#include <vector>

#include "formats/recording/message_sink.h"

namespace throng::formats::ros {

/// The frame of the run's coordinates.
inline constexpr const char* kWorldFrame = "world";

/// /clock, which never goes back.
class ClockTopic {
 public:
  explicit ClockTopic(MessageSink sink) : sink_(std::move(sink)) {}

  /// Publishes the time if it is later than the last one.
  void advance(double time_s);

 private:
  MessageSink sink_;
  double last_s_ = -1;
};

/// ROOT/ground_truth/boxes and ROOT/ground_truth/detections_3d: the same boxes in the world, as
/// cubes to be drawn and as detections. `root` is "" or "/" and a drone's name.
void publish_boxes(const MessageSink& sink, const std::string& root, double time_s,
                   const std::vector<Box3>& boxes);

}  // namespace throng::formats::ros
