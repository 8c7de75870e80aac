// Common parts of the pedestrian models in which each agent decides alone, from what it sees.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "base/compute/random.h"
#include "crowd/model.h"
#include "crowd/spatial/neighborhood.h"

namespace throng::crowd {

/// Limits a velocity that forces ask for to max_speed; one that is not finite leaves the velocity
/// as it is.
Eigen::Vector2f possible_velocity(const Crowd& crowd, std::size_t agent,
                                  const Eigen::Vector2f& velocity);

/// v at unit length; `otherwise` when v has none.
Eigen::Vector2f unit_or(const Eigen::Vector2f& v, const Eigen::Vector2f& otherwise);

/// The time in s, not negative, after which a point at `offset` from the center of a disc is in it
/// if it moves with `velocity`: 0 when it is there already, nothing when it never will be.
std::optional<float> time_to_disc(const Eigen::Vector2f& offset, const Eigen::Vector2f& velocity,
                                  float radius);

/// The random numbers of an agent in a step.
Random noise(const Crowd& crowd, std::size_t agent);

/// A unit vector, all directions being equally likely.
Eigen::Vector2f any_direction(Random& random);

/// Somebody as they and others see them.
struct Walker {
  Walker(const Crowd& crowd, const Grid& grid, std::size_t slot);

  std::size_t id;
  Eigen::Vector2f position;
  Eigen::Vector2f velocity;
  float radius;
  float preferred_speed;
  Eigen::Vector2f preferred_direction;  ///< unit
  Eigen::Vector2f orientation;          ///< unit

  Eigen::Vector2f preferred_velocity() const { return preferred_speed * preferred_direction; }
};

/// Position of another agent, seen from a walker.
struct BodyOffset {
  BodyOffset(const Walker& self, std::size_t other, const Eigen::Vector2f& other_position);
  BodyOffset(const Walker& self, const Segment& wall);

  Eigen::Vector2f offset;  ///< from the other, or from the wall's nearest point, to the walker, m
  float distance;          ///< m
  /// The offset at unit length. Of two in one place the one with the higher id has the other on
  /// the left; who stands on a wall goes where it faces.
  Eigen::Vector2f away;
};

/// Whether the point of the wall that is nearest to p is another wall's to deal with: of a corner
/// that two walls share and show to p, only the one that begins there counts.
bool is_shared_corner(const std::vector<Segment>& segments, const Segment& wall,
                      const Eigen::Vector2f& p);

/// Calls act(wall) for the walls around an agent, nearest first, without those that it sees a
/// shared corner of.
template <typename Act>
void for_each_wall(const Crowd& crowd, const Grid& grid, const AgentView& around, const Act& act) {
  const std::vector<Segment>& segments = crowd.obstacles.segments();
  for (const Obstacles::Near& near : around.walls) {
    const Segment& wall = segments[near.segment];
    if (!is_shared_corner(segments, wall, grid.position(around.slot))) act(wall);
  }
}

/// A model whose new velocities are functions of what everybody sees.
class LocalModel : public Model {
 public:
  explicit LocalModel(const Crowd& crowd) : neighborhood_(crowd) {}

  void step(const Crowd& crowd, const Grid& grid, std::span<Eigen::Vector2f> new_velocity) final;

 protected:
  /// The new velocity of around.agent, m/s. Called for different agents at once. A result that
  /// is not finite leaves the velocity as it is.
  virtual Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid,
                                   const AgentView& around) = 0;
  /// How near walls have to be to matter to the agent of a slot, m; farther than the agent sees
  /// none do.
  virtual float wall_range_m(const Crowd& crowd, const Grid& grid, std::size_t slot) const;
  /// Before the agents of a step, by the thread that starts it.
  virtual void prepare() {}

 private:
  Neighborhood neighborhood_;
};

}  // namespace throng::crowd
