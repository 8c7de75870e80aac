// Messages of topics on their way to a recording, or to those who look on.
#pragma once

#include <functional>
#include <string>

#include "formats/files/ros_messages.h"

namespace throng::formats::ros {

/// A message and its topic. All messages of a topic have the same kind.
struct TopicMessage {
  std::string topic;
  Kind kind = Kind::clock;
  double time_s = 0;  ///< from the run's start
  std::string bytes;  ///< CDR
};

using MessageSink = std::function<void(const TopicMessage&)>;

}  // namespace throng::formats::ros
