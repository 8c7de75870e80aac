// Rotors, battery and sensors of a robot in the <plugin>s of Gazebo, PX4, RotorS and hector.
#pragma once

#include <sdf/sdf.hh>

#include "places/imports/robots/robot.h"
#include "places/imports/robots/robot_source.h"

namespace throng::imports {

/// Reads one plugin into `robot`: a motor (of any plugin with a <motorConstant>) becomes a rotor
/// without position, which its link has; a battery and noise of sensors become values; all others
/// are listed. Throws InputError (file, line) if a number is missing or no number.
void read_plugin(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot);

}  // namespace throng::imports
