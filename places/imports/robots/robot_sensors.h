// A robot's cameras and the errors of its other sensors in <sensor>s.
#pragma once

#include <Eigen/Geometry>
#include <sdf/sdf.hh>
#include <string>

#include "places/imports/robots/robot.h"
#include "places/imports/robots/robot_source.h"

namespace throng::imports {

/// Reads one sensor of a link into `robot`; `link` is the link's pose, `is_movable` says whether
/// joints turn it. Sensors without counterpart are listed. Throws InputError (file, line).
void read_sensor(const RobotSource& source, const sdf::Sensor& sensor,
                 const Eigen::Isometry3d& link, bool is_movable, Robot& robot);

}  // namespace throng::imports
