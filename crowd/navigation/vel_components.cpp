#include "crowd/navigation/navigation.h"
#include "crowd/navigation/steering.h"

namespace throng::crowd {

namespace {

/// Straight to the goal, without looking at what stands between.
class ToGoal : public VelComponent {
 public:
  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) override {
    head_for(crowd, agent, goal_place(crowd, agent, crowd.agents.position[agent]), preferred);
  }
};

/// A constant direction, at a constant speed or at the agent's preferred one.
class Constant : public VelComponent {
 public:
  enum class Speed { of_vector, preferred };
  Constant(const Eigen::Vector2f& velocity, Speed speed)
      : direction_(velocity.normalized()), length_(velocity.norm()), speed_(speed) {}

  void prefer(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) override {
    if (length_ > 0) preferred.direction = direction_;
    preferred.speed =
        speed_ == Speed::preferred ? crowd.agents[Property::pref_speed][agent] : length_;
  }

 private:
  Eigen::Vector2f direction_;
  float length_;
  Speed speed_;
};

std::unique_ptr<VelComponent> make_to_goal(const Element&, const Attributes&, BehaviorContext&) {
  return std::make_unique<ToGoal>();
}

Eigen::Vector2f read_vector(const Attributes& attributes) {
  return {attributes.real("x"), attributes.real("y")};
}

std::unique_ptr<VelComponent> make_constant(const Element&, const Attributes& attributes,
                                            BehaviorContext&) {
  return std::make_unique<Constant>(read_vector(attributes), Constant::Speed::of_vector);
}

std::unique_ptr<VelComponent> make_constant_direction(const Element& element,
                                                      const Attributes& attributes,
                                                      BehaviorContext&) {
  const Eigen::Vector2f direction = read_vector(attributes);
  if (direction.isZero(0)) element.fail("x and y of 0", "a direction");
  return std::make_unique<Constant>(direction, Constant::Speed::preferred);
}

std::unique_ptr<VelComponent> make_zero(const Element&, const Attributes&, BehaviorContext&) {
  return std::make_unique<Constant>(Eigen::Vector2f::Zero(), Constant::Speed::of_vector);
}

}  // namespace

const VelComponentRegistry& vel_component_registry() {
  static const VelComponentRegistry kRegistry({{
      {"goal", "straight to the goal", {}, make_to_goal},
      {"const",
       "one velocity for all",
       {number("x", "in m/s", -100, 100), number("y", "in m/s", -100, 100)},
       make_constant},
      {"const_dir",
       "one direction for all",
       {number("x", "of the direction"), number("y", "of the direction")},
       make_constant_direction},
      {"zero", "stand", {}, make_zero},
      auto_component(),
      nav_mesh_component(),
      road_map_component(),
      vector_field_component(),
  }});
  return kRegistry;
}

}  // namespace throng::crowd
