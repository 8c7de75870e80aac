// The state of all agents: one array per quantity, indexed by agent id.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "crowd/agents/types.h"

namespace throng::crowd {

/// Properties that profiles set for each agent and that actions change.
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

/// Definition of a Property.
struct PropertySpec {
  std::string_view name;  ///< name in files
  float initial;          ///< value if a profile does not set it, in the unit of the file
  float min;
  float max;
  float file_unit;  ///< factor from the unit of the file to that of the arrays
  std::string_view help;
};

constexpr float kRadiansPerDegree = 0.017453292519943295F;

/// Indexed by Property. Values are clamped to these limits at all times.
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

  /// The classes of obstacles around which the agent plans its way.
  std::uint32_t known_mask(std::size_t agent) const {
    return obstacle_mask[agent] & ~unseen_mask[agent];
  }

  std::vector<std::uint8_t> present;  ///< 1: takes part
  std::vector<std::uint8_t> awaited;  ///< 1: still to arrive, see Arrivals
  std::vector<std::uint8_t> panicked;
  std::vector<std::uint8_t> fallen;        ///< 1: lies on the ground, see Bodies
  std::vector<std::int32_t> social_group;  ///< index into Crowd::social_groups; -1: alone
  /// Share of the radius that the body takes now; below 1 where shoulders are turned.
  std::vector<float> breadth;
  std::vector<Eigen::Vector2f> position;     ///< m
  std::vector<Eigen::Vector2f> velocity;     ///< m/s
  std::vector<Eigen::Vector2f> orientation;  ///< unit
  std::vector<float> yaw_rad;
  /// Initial facing (unit vector) of an agent that stands, see Facing; 0: faces along its path.
  std::vector<Eigen::Vector2f> facing;

  /// Preferred velocity without other agents: a unit vector, and a speed in m/s.
  std::vector<Eigen::Vector2f> preferred_direction;
  std::vector<float> preferred_speed;

  std::array<std::vector<float>, kPropertyCount> properties;
  std::vector<std::uint32_t> obstacle_mask;  ///< classes of obstacles that the agent avoids
  std::vector<std::uint32_t> unseen_mask;    ///< those of them that its plans do not know of yet
  std::vector<std::int32_t> agent_class;
  std::vector<std::uint32_t> profile;  ///< index of the <AgentProfile> in the scene
  /// Indexed by parameter of the pedestrian model's table, then by agent.
  std::vector<std::vector<float>> model_parameters;

  std::vector<std::uint8_t> state;
  std::vector<std::uint8_t> previous_state;
  std::vector<double> entered_s;     ///< time of entry into the state
  std::vector<std::uint32_t> entry;  ///< number of states entered, including the first
  std::vector<std::int32_t> goal;    ///< index into Goals; -1: own_goal
  std::vector<Eigen::Vector2f> own_goal;
  std::vector<GoalId> goal_id;
};

}  // namespace throng::crowd
