// A camera of Gazebo as the camera of a drone.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "places/imports/gazebo/camera_sensor.h"

namespace throng::imports {

/// The fields of a job's drones[].camera: size, lens, direction, mount relative to `center` (the
/// drone's center) and gimbal. Appends to `assumptions` what these fields cannot say.
nlohmann::ordered_json camera_json(const CameraSensor& camera, const Eigen::Vector3d& center,
                                   std::vector<std::string>& assumptions);

/// Why jobs refuse such a camera; nothing if they take it.
std::optional<std::string> camera_refusal(const nlohmann::ordered_json& camera);

}  // namespace throng::imports
