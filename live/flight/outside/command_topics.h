// Topics on which clients command drones (docs/robotics.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "spec/live/commands.h"

namespace throng::live {

/// A message that a client has published.
struct PublishedCommand {
  std::string topic;        ///< such as /d1/cmd_vel
  std::string encoding;     ///< json or cdr
  std::string schema_name;  ///< such as geometry_msgs/msg/Twist; needed for cdr
  std::string_view bytes;
};

/// The topics of a flight's drones. Values only: safe to use from many threads.
class CommandTopics {
 public:
  /// The drones, and their names in ROS in the same order.
  CommandTopics(std::vector<FlownDrone> drones, std::vector<std::string> names);

  /// Throws InputError for a topic, encoding or schema that commands do not have.
  void check(const PublishedCommand& channel) const;

  /// Reads a message of a topic. Throws InputError that names the topic and the field.
  Commands read(const PublishedCommand& message) const;

 private:
  struct Target {
    std::size_t drone = 0;
    std::size_t kind = 0;  ///< index in the table of kinds
  };
  Target find(const std::string& topic) const;

  std::vector<FlownDrone> drones_;
  std::vector<std::string> names_;
};

}  // namespace throng::live
