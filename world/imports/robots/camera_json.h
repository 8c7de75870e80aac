// A robot's camera as the camera of a drone.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "world/imports/robots/robot.h"

namespace throng::imports {

/// The fields of a job's drones[].camera: size, lens, direction, mount relative to `center` (the
/// robot's center of mass) and gimbal. Appends to `assumptions` what these fields cannot say.
nlohmann::ordered_json camera_json(const RobotCamera& camera, const Eigen::Vector3d& center,
                                   std::vector<std::string>& assumptions);

}  // namespace throng::imports
