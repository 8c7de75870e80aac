#include "crowd/agents/agents.h"

namespace throng::crowd {

void Agents::resize(std::size_t count, std::size_t model_parameter_count) {
  const Eigen::Vector2f zero = Eigen::Vector2f::Zero();
  present.resize(count, 1);
  awaited.resize(count, 0);
  panicked.resize(count, 0);
  fallen.resize(count, 0);
  social_group.resize(count, -1);
  breadth.resize(count, 1);
  position.resize(count, zero);
  velocity.resize(count, zero);
  orientation.resize(count, Eigen::Vector2f::UnitX());
  yaw_rad.resize(count, 0);
  facing.resize(count, zero);
  preferred_direction.resize(count, Eigen::Vector2f::UnitX());
  preferred_speed.resize(count, 0);
  for (std::vector<float>& values : properties) values.resize(count, 0);
  obstacle_mask.resize(count, std::numeric_limits<std::uint32_t>::max());
  unseen_mask.resize(count, 0);
  agent_class.resize(count, 0);
  profile.resize(count, 0);
  model_parameters.resize(model_parameter_count);
  for (std::vector<float>& values : model_parameters) values.resize(count, 0);
  state.resize(count, 0);
  previous_state.resize(count, 0);
  entered_s.resize(count, 0);
  entry.resize(count, 0);
  goal.resize(count, -1);
  own_goal.resize(count, zero);
  goal_id.resize(count);
}

}  // namespace throng::crowd
