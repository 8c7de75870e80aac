// Checks of a URDF file before libsdformat converts it, which reports neither lines nor what it
// drops.
#pragma once

#include <map>
#include <string>

namespace throng::imports {

/// Figures with which the converted model must agree.
struct UrdfFacts {
  double mass_kg = 0;                ///< of all links
  std::map<std::string, int> lines;  ///< of links, joints, sensors and plugins, by their names
};

/// Checks links, inertias and joints. Throws InputError (`name`, line) with all problems; for a
/// xacro file, with the command that expands it.
UrdfFacts check_urdf(const std::string& name, const std::string& text);

}  // namespace throng::imports
