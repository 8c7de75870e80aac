// The agents' state, one array per quantity, indexed by agent id.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "crowd/types.h"

namespace throng::crowd {

/// Properties that profiles set for each agent and actions change.
enum class Property {
  max_speed,
  max_accel,
  pref_speed,
  max_angle_vel,
  neighbor_dist,
  radius,
  priority,
  max_neighbors,
};
constexpr std::size_t kPropertyCount = 8;

struct PropertySpec {
  std::string_view name;  ///< as in the files
  float initial;          ///< what a profile that does not give it has, in the file's unit
  float min;
  float max;
  float file_unit;  ///< what one unit of a profile's attribute is in the arrays' unit
  std::string_view help;
};

constexpr float kRadiansPerDegree = 0.017453292519943295F;

/// By Property. The limits hold at any time: what actions do is clamped to them.
constexpr std::array<PropertySpec, kPropertyCount> kProperties = {{
    {"max_speed", 2.5F, 0, 100, 1, "highest speed in m/s"},
    {"max_accel", 2, 0, 1e9F, 1, "highest change of velocity in m/s^2"},
    {"pref_speed", 1.34F, 0, 100, 1, "speed when nothing is in the way, in m/s"},
    {"max_angle_vel", 360, 0, 1e6F, kRadiansPerDegree, "fastest turn in degrees/s"},
    {"neighbor_dist", 5, 0, 1000, 1, "how far others and obstacles are noticed, in m"},
    {"r", 0.2F, 0.01F, 100, 1, "radius in m"},
    {"priority", 0, -1000, 1000, 1, "right of way"},
    {"max_neighbors", 10, 0, 1000, 1, "how many others are noticed"},
}};

constexpr const PropertySpec& property_spec(Property property) {
  return kProperties[static_cast<std::size_t>(property)];
}

struct Agents {
  std::size_t count() const { return position.size(); }
  void resize(std::size_t count, std::size_t model_parameters);

  std::vector<float>& operator[](Property property) {
    return properties[static_cast<std::size_t>(property)];
  }
  const std::vector<float>& operator[](Property property) const {
    return properties[static_cast<std::size_t>(property)];
  }

  std::vector<std::uint8_t> present;  ///< 1: takes part
  std::vector<std::uint8_t> awaited;  ///< 1: is still to arrive, see Arrivals
  std::vector<std::uint8_t> panicked;
  std::vector<std::uint8_t> fallen;          ///< 1: lies on the ground, see Bodies
  std::vector<std::int32_t> social_group;    ///< index into Crowd::social_groups; -1: alone
  std::vector<Eigen::Vector2f> position;     ///< m
  std::vector<Eigen::Vector2f> velocity;     ///< m/s
  std::vector<Eigen::Vector2f> orientation;  ///< unit
  std::vector<float> yaw_rad;
  /// Unit: facing of an agent that stands where it began, see Facing; 0: along its path.
  std::vector<Eigen::Vector2f> facing;

  /// Preferred velocity, without other agents: a unit vector and m/s.
  std::vector<Eigen::Vector2f> preferred_direction;
  std::vector<float> preferred_speed;

  std::array<std::vector<float>, kPropertyCount> properties;
  std::vector<std::uint32_t> obstacle_mask;  ///< obstacles of these classes are in the way
  std::vector<std::int32_t> agent_class;
  std::vector<std::uint32_t> profile;  ///< number of the <AgentProfile> in the scene
  /// Per parameter of the pedestrian model's table, per agent.
  std::vector<std::vector<float>> model_parameters;

  std::vector<std::uint8_t> state;
  std::vector<std::uint8_t> previous_state;
  std::vector<double> entered_s;     ///< when the state was entered
  std::vector<std::uint32_t> entry;  ///< how many states were entered, including the first
  std::vector<std::int32_t> goal;    ///< index into Goals; -1: own_goal
  std::vector<Eigen::Vector2f> own_goal;
  std::vector<GoalId> goal_id;
};

}  // namespace throng::crowd
