// Names of drones in topics and frames of ROS.
#pragma once

#include <map>
#include <string>

namespace throng::formats::ros {

/// The names of one run's drones: ROS has no '-' and no digit at the beginning.
class RosNames {
 public:
  /// `source` is what errors name: the file, folder or job with the drones.
  explicit RosNames(std::string source) : source_(std::move(source)) {}

  /// The name of a drone. Throws InputError where another drone has the same.
  std::string name_of(const std::string& drone);

 private:
  std::string source_;
  std::map<std::string, std::string> drones_;  ///< by name in ROS
};

}  // namespace throng::formats::ros
