// Plugins by which a model is one that flies.
#pragma once

#include <sdf/sdf.hh>

namespace throng::imports {

/// Whether a plugin drives a rotor: those of Gazebo, PX4 and RotorS, whose elements have the same
/// names.
bool is_motor(const sdf::ElementPtr& plugin);

/// Whether a plugin is hector's propulsion or aerodynamics, whose constants lie in ROS parameters.
bool is_hector_propulsion(const sdf::ElementPtr& plugin);

}  // namespace throng::imports
