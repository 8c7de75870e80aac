#include "places/imports/gazebo/motor_plugin.h"

#include <string>

namespace throng::imports {

bool is_motor(const sdf::ElementPtr& plugin) { return plugin->HasElement("motorConstant"); }

bool is_hector_propulsion(const sdf::ElementPtr& plugin) {
  if (!plugin->HasAttribute("filename")) return false;
  const auto library = plugin->Get<std::string>("filename");
  return library.find("hector_gazebo_quadrotor_propulsion") != std::string::npos ||
         library.find("hector_gazebo_quadrotor_aerodynamics") != std::string::npos;
}

}  // namespace throng::imports
