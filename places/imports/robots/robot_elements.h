// Values of SDF elements that plugins and sensors contain.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <sdf/sdf.hh>
#include <string>

#include "places/imports/robots/robot_source.h"

namespace throng::imports {

/// The number in the child `name`; nothing without that child. Throws InputError (file, line) if it
/// is no number.
std::optional<double> number_in(const RobotSource& source, const sdf::ElementPtr& element,
                                const std::string& name);

/// One number for all axes, or three. Throws InputError like number_in().
std::optional<Eigen::Vector3d> axes_in(const RobotSource& source, const sdf::ElementPtr& element,
                                       const std::string& name);

/// The text of the child `name`, "" without it.
std::string text_in(const sdf::ElementPtr& element, const std::string& name);

/// The attribute `name`, "" without it.
std::string read_attribute(const sdf::ElementPtr& element, const std::string& name);

}  // namespace throng::imports
