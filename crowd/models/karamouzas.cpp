#include <algorithm>
#include <array>
#include <cmath>

#include "crowd/models/local_model.h"

namespace throng::crowd {

namespace {

constexpr float kRadiansPerHalfDegree = 0.5F * kRadiansPerDegree;
constexpr std::size_t kMaxColliding = 100;

enum Parameter : std::size_t { personal_space, anticipation };
enum Constant : std::size_t {
  orient_weight,
  fov,
  reaction_time,
  wall_steepness,
  wall_distance,
  colliding_count,
  d_min,
  d_mid,
  d_max,
  agent_force
};

/// The most urgent of the collisions added to it, soonest first.
class Urgent {
 public:
  struct Collision {
    float time_s = 0;
    std::uint32_t slot = 0;  // of the other
  };

  explicit Urgent(std::size_t max_neighbors) : max_neighbors_(max_neighbors) {}

  void add(float time_s, std::uint32_t slot) {
    std::size_t at = count_;
    while (at > 0 && collisions_[at - 1].time_s > time_s) --at;
    if (at >= max_neighbors_) return;
    if (count_ < max_neighbors_) ++count_;
    std::copy_backward(collisions_.begin() + at, collisions_.begin() + count_ - 1,
                       collisions_.begin() + count_);
    collisions_[at] = {time_s, slot};
  }
  std::span<const Collision> all() const { return std::span(collisions_).first(count_); }

 private:
  std::array<Collision, kMaxColliding> collisions_;
  std::size_t max_neighbors_;
  std::size_t count_ = 0;
};

/// Forces that keep people out of each other's personal space in time (Karamouzas, Heil, van Beek
/// and Overmars 2009).
class Karamouzas : public LocalModel {
 public:
  explicit Karamouzas(const Crowd& crowd)
      : LocalModel(crowd),
        constants_(crowd.model_constants),
        min_cosine_(std::cos(kRadiansPerHalfDegree * constants_[fov])) {}

 protected:
  Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid, const AgentView& around) override {
    const Walker self(crowd, grid, around.slot);
    const Agents& agents = crowd.agents;
    const auto dt_s = static_cast<float>(crowd.dt_s);
    const Eigen::Vector2f desired = self.velocity + dt_s * drive(crowd, grid, around, self);
    Eigen::Vector2f force = evade(crowd, grid, around, self, desired) + shiver(crowd, self);
    const float strength = force.norm();
    const float max_acceleration_mps2 = agents[Property::max_accel][self.id];
    if (strength > max_acceleration_mps2) force *= max_acceleration_mps2 / strength;
    return desired + dt_s * force;
  }

 private:
  /// The accelerations towards the preferred velocity and away from walls.
  Eigen::Vector2f drive(const Crowd& crowd, const Grid& grid, const AgentView& around,
                        const Walker& self) const {
    Eigen::Vector2f sum = (self.preferred_velocity() - self.velocity) / constants_[reaction_time];
    for_each_wall(crowd, grid, around, [&](const Segment& wall) {
      constexpr float kMinDistance = 0.01F;  // m
      const BodyOffset apart(self, wall);
      const float gap = apart.distance - self.radius;
      if (gap >= constants_[wall_distance]) return;
      sum += (constants_[wall_distance] - gap) /
             std::pow(std::max(gap, kMinDistance), constants_[wall_steepness]) * apart.away;
    });
    return sum;
  }

  /// The force that evades the most urgent collisions; of somebody in whose personal space others
  /// are already, the one away from all of these, however many (in Menge's series of pedModelSwap
  /// colliding_count does not limit them: its mean speeds are met to 1 % over 4 s only so).
  Eigen::Vector2f evade(const Crowd& crowd, const Grid& grid, const AgentView& around,
                        const Walker& self, const Eigen::Vector2f& desired) const {
    const float space = crowd.agents.model_parameters[personal_space][self.id];
    const float horizon_s = crowd.agents.model_parameters[anticipation][self.id];
    const Eigen::Vector2f facing = unit_or(desired, self.orientation);
    Urgent soon(static_cast<std::size_t>(constants_[colliding_count]));
    bool colliding = false;
    Eigen::Vector2f force = Eigen::Vector2f::Zero();
    for (const Grid::Neighbor& neighbor : around.neighbors) {
      const Eigen::Vector2f offset = self.position - grid.position(neighbor.slot);
      const float radius = space + grid.radius(neighbor.slot);
      if (offset.squaredNorm() < radius * radius) {
        colliding = true;
        force += push(grid, self, desired, {0, neighbor.slot});
      } else if (-offset.dot(facing) >= min_cosine_ * offset.norm()) {
        const auto time_s = time_to_disc(offset, desired - grid.velocity(neighbor.slot), radius);
        if (time_s && *time_s < horizon_s) soon.add(*time_s, neighbor.slot);
      }
    }
    if (colliding) return force;
    float weight = 1;
    for (const Urgent::Collision& collision : soon.all()) {
      constexpr float kLess = 0.8F;  // for each that is less urgent
      force += weight * push(grid, self, desired, collision);
      weight *= kLess;
    }
    return force;
  }

  Eigen::Vector2f push(const Grid& grid, const Walker& self, const Eigen::Vector2f& desired,
                       const Urgent::Collision& collision) const {
    const std::uint32_t slot = collision.slot;
    const BodyOffset apart(self, grid.id(slot), grid.position(slot));
    const Eigen::Vector2f later = apart.offset + collision.time_s * (desired - grid.velocity(slot));
    const float gap = std::max(0.0F, later.norm() - self.radius - grid.radius(slot));
    return strength(desired.norm() * collision.time_s + gap) * unit_or(later, apart.away);
  }

  /// By the way that is left until the collision.
  float strength(float distance) const {
    const float full = constants_[agent_force];
    if (distance < constants_[d_min]) {
      constexpr float kMinDistance = 1e-3F;  // m
      return full * constants_[d_min] / std::max(distance, kMinDistance);
    }
    if (distance < constants_[d_mid]) return full;
    if (distance >= constants_[d_max]) return 0;
    return full * (constants_[d_max] - distance) / (constants_[d_max] - constants_[d_mid]);
  }

  /// Keeps two who head for each other exactly from going on so forever.
  static Eigen::Vector2f shiver(const Crowd& crowd, const Walker& self) {
    constexpr double kStrongest = 0.001;  // m/s^2
    Random random = noise(crowd, self.id);
    const Eigen::Vector2f direction = any_direction(random);
    return static_cast<float>(random.uniform(0, kStrongest)) * direction;
  }

  const std::vector<float>& constants_;
  float min_cosine_;
};

std::unique_ptr<Model> make_karamouzas(const Crowd& crowd) {
  return std::make_unique<Karamouzas>(crowd);
}

}  // namespace

ModelEntry karamouzas_model() {
  return {
      "karamouzas",
      "Karamouzas",
      "forces that keep people out of each other's personal space in time (Karamouzas et al. 2009)",
      {{"personal_space", 1, 0.01F, 100, "kept free of others, radius in m"},
       {"anticipation", 3, 0, 1000, "how far ahead collisions are seen, in s"}},
      {{"orient_weight", 0.8F, 0, 1, "not used, as in Menge"},
       {"fov", 200, 0, 360, "field of view, in degrees"},
       {"reaction_time", 0.4F, 1e-3F, 1000, "in which the preferred velocity is taken, in s"},
       {"wall_steepness", 2, 0, 10, "exponent of the walls' push"},
       {"wall_distance", 2, 0, 100, "from how far walls push, in m"},
       {"colliding_count", 5, 0, kMaxColliding, "how many coming collisions are evaded at once"},
       {"d_min", 1, 0, 1000, "below this distance to a collision, the force grows, in m"},
       {"d_mid", 8, 0, 1000, "above this distance to a collision, the force falls, in m"},
       {"d_max", 10, 0, 1000, "from this distance to a collision, there is no force, in m"},
       {"agent_force", 3, 0, 1e4F, "strength of the push by others, in m/s^2"}},
      make_karamouzas};
}

}  // namespace throng::crowd
