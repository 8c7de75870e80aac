// A robot as an airframe of jobs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "places/imports/robots/robot.h"
#include "spec/sim/airframe.h"

namespace throng::imports {

/// Choices that a description leaves open.
struct AirframeChoices {
  /// Gives what the description does not: rotors, drag, autopilot, battery.
  std::optional<sim::Airframe> base;
  std::string camera;  ///< name of the camera that becomes the drone's; "": the first in color
};

/// The fields of a job's drones[].airframe, with "camera" if the robot has one. Appends to
/// `assumptions` a line for each value that the description does not state. Throws InputError
/// (`file`) if the robot is no quadcopter with four equal rotors, or one that throng cannot fly.
nlohmann::ordered_json airframe_json(const Robot& robot, const std::string& file,
                                     const AirframeChoices& choices,
                                     std::vector<std::string>& assumptions);

}  // namespace throng::imports
