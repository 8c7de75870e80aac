#include "formats/recording/ros_names.h"

#include <algorithm>
#include <cctype>

#include "base/error.h"

namespace throng::formats::ros {

std::string RosNames::name_of(const std::string& drone) {
  std::string name = drone;
  std::replace(name.begin(), name.end(), '-', '_');
  if (std::isdigit(static_cast<unsigned char>(name.front())) != 0) name = "drone_" + name;
  const auto [found, is_new] = drones_.try_emplace(name, drone);
  if (!is_new && found->second != drone) {
    throw InputError({source_, "topics /" + name + "/...", drone + " and " + found->second,
                      "drones whose names differ in ROS, which has no '-'"});
  }
  return name;
}

}  // namespace throng::formats::ros
