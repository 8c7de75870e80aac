// Common functions of pedestrian models in which each agent decides from its own view.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "base/compute/random.h"
#include "crowd/state/model.h"
#include "crowd/state/neighborhood.h"

namespace throng::crowd {

/// Limits a velocity that forces demand to max_speed. Returns the current velocity if it is not
/// finite.
Eigen::Vector2f possible_velocity(const Crowd& crowd, std::size_t agent,
                                  const Eigen::Vector2f& velocity);

/// Returns v normalized, or `otherwise` if v is 0.
Eigen::Vector2f unit_or(const Eigen::Vector2f& v, const Eigen::Vector2f& otherwise);

/// Returns the time (s, not negative) until a point at `offset` from the center of a disc, moving
/// with `velocity`, enters the disc: 0 if it is inside, nothing if it never enters.
std::optional<float> time_to_disc(const Eigen::Vector2f& offset, const Eigen::Vector2f& velocity,
                                  float radius);

/// Returns the random numbers of an agent in the current step.
Random noise(const Crowd& crowd, std::size_t agent);

/// Returns a random unit vector, uniform over all directions.
Eigen::Vector2f any_direction(Random& random);

/// The state of an agent that its model needs.
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

/// Position of another agent or of a wall relative to a walker.
struct BodyOffset {
  BodyOffset(const Walker& self, std::size_t other, const Eigen::Vector2f& other_position);
  BodyOffset(const Walker& self, const Segment& wall);

  /// From the other agent, or from the nearest point of the wall, to the walker, m.
  Eigen::Vector2f offset;
  float distance;  ///< m
  /// The offset, normalized. For two agents at the same position, the one with the higher id has
  /// the other on its left; on a wall, the direction in which the wall faces.
  Eigen::Vector2f away;
};

/// Whether the point of a wall nearest to p is a corner that another wall handles: if two walls
/// share a corner and both face p, only the wall that begins there counts.
bool is_shared_corner(const std::vector<Segment>& segments, const Segment& wall,
                      const Eigen::Vector2f& p);

/// Returns the square of the distance (m^2) up to which the agent knows all others: `reach_m`, its
/// range, or the distance of its last neighbor if it sees as many as it can.
float known_reach_sq(const Crowd& crowd, const AgentView& around, float reach_m);

/// Calls act(wall) for the walls around an agent, nearest first, and for each shared corner once.
template <typename Act>
void for_each_wall(const Crowd& crowd, const Grid& grid, const AgentView& around, const Act& act) {
  const std::vector<Segment>& segments = crowd.obstacles.segments();
  for (const Obstacles::Near& near : around.walls) {
    const Segment& wall = segments[near.segment];
    if (!is_shared_corner(segments, wall, grid.position(around.slot))) act(wall);
  }
}

/// A model that computes each new velocity from the agent's own view.
class LocalModel : public Model {
 public:
  explicit LocalModel(const Crowd& crowd) : neighborhood_(crowd) {}

  void step(const Crowd& crowd, const Grid& grid, std::span<Eigen::Vector2f> new_velocity) final;

 protected:
  /// Returns the new velocity of around.agent (m/s). Called for several agents concurrently. If the
  /// result is not finite, the velocity does not change.
  virtual Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid,
                                   const AgentView& around) = 0;
  /// Max distance (m) of walls that matter to the agent in a slot; it is limited to the agent's own
  /// range.
  virtual float wall_range_m(const Crowd& crowd, const Grid& grid, std::size_t slot) const;
  /// Called once per step before the agents, by the thread that starts the step.
  virtual void prepare() {}

 private:
  Neighborhood neighborhood_;
};

}  // namespace throng::crowd
