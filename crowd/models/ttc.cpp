// The time-to-collision law with a fundamental diagram: people see collisions coming and avoid them
// early, and in a crowd that walks their way they are as slow as measured.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/geometry/polygon.h"
#include "crowd/models/half_planes.h"
#include "crowd/models/local_model.h"
#include "crowd/models/oncoming.h"
#include "crowd/models/orca_lines.h"
#include "crowd/models/single_file.h"

namespace throng::crowd {

namespace {

enum Constant : std::size_t {
  strength,
  horizon,
  relaxation,
  reach,
  half_density,
  steepness,
  jam_share,
  perception,
  keep_right,
  headway
};

/// Forces between discs are integrated with this step, whatever the simulation's step is.
constexpr float kStepS = 0.02F;
/// Collisions farther ahead in time are not seen; nearer ones count as if they were this near.
constexpr float kMaxHorizonS = 8;
constexpr float kMinTimeS = 0.02F;
constexpr float kMinRelativeSpeedSq = 1e-4F;  // m^2/s^2: relative velocities below never collide
constexpr float kBehind = 0.3F;               // how much counts what is not in view
constexpr float kView = -0.2F;                // cosine of the edge of the view
constexpr float kAlongside = 0.7F;            // of the force between two who walk the same way
constexpr float kMaxForce = 15;               // m/s^2
constexpr float kSamePosition = 1e-3F;        // m: nearer than that two have no direction
constexpr float kSamePositionSq = kSamePosition * kSamePosition;
constexpr float kContact = 100;         // 1/s^2: force per depth of an overlap
constexpr float kWall = 10;             // m/s^2 at a wall
constexpr float kWallRangeM = 0.03F;    // over which that falls to 1/e
constexpr float kWallReachM = 1;        // walls farther away do not count
constexpr float kWallHorizonS = 0.15F;  // how long moves stay free of walls
constexpr float kShuffleMps = 0.1F;  // forces make nobody faster than this or than they want to be
constexpr float kCreep = 0.05F;      // of the free speed, in single file without a gap
/// How fast one steps back at most, per person and m^2 of those who do not walk the same way.
constexpr float kStepBack = 4;  // m^3/s

/// The density of people around one agent, weighted by how far they are ahead.
struct Density {
  float same = 0;      ///< 1/m^2, of those who walk the same way
  float oncoming = 0;  ///< 1/m^2, ahead
  float others = 0;    ///< 1/m^2, of those who do not walk the same way
};

/// Another, as seen by one agent at the beginning of a step.
struct Other {
  Eigen::Vector2f offset;  ///< from the agent
  Eigen::Vector2f velocity;
  float touch;   ///< distance of the centers at contact
  float weight;  ///< of the force between the two if the other is in view
};

/// One agent's view and the buffers for its velocity; kept, so that a step allocates
/// nothing.
struct Seen {
  std::vector<Other> others;
  std::vector<Eigen::Vector2f> walls;  ///< their nearest points, from the agent
  Density density;
  HalfPlanes planes;
  HalfPlanes scratch;
};

/// The acceleration of a disc by the time-to-collision law of Karamouzas, Skinner and Guy (2014,
/// Phys. Rev. Lett. 113, 238701): minus the gradient of strength t^-2 exp(-t / horizon), t being
/// the time to the collision of two discs that are `offset` apart (from the other), move at
/// `relative` to each other and touch at `touch`.
Eigen::Vector2f avoidance(const Eigen::Vector2f& offset, float distance,
                          const Eigen::Vector2f& relative, float touch, float strength_m2,
                          float horizon_s) {
  const float a = relative.squaredNorm();
  const float b = -offset.dot(relative);
  const float discriminant = b * b - a * (distance * distance - touch * touch);
  if (a <= kMinRelativeSpeedSq || b <= 0 || discriminant <= 0) return Eigen::Vector2f::Zero();
  const float root = std::sqrt(discriminant);
  const float t = std::max((b - root) / a, kMinTimeS);
  if (t >= kMaxHorizonS) return Eigen::Vector2f::Zero();
  const float slope = strength_m2 * std::exp(-t / horizon_s) / (t * t) * (2 / t + 1 / horizon_s);
  // Discs that would just graze each other have a gradient without limit.
  constexpr float kGrazing = 0.05F;
  const float smooth_root = std::max(root, kGrazing * std::sqrt(a));
  return slope / a * ((b * relative + a * offset) / smooth_root - relative);
}

class TimeToCollision : public LocalModel {
 public:
  explicit TimeToCollision(const Crowd& crowd)
      : LocalModel(crowd),
        constants_(crowd.model_constants),
        seen_(room_for(crowd.obstacles.segments().size())),
        perceived_(crowd.agents.count(), 0.0F) {}

 protected:
  Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid, const AgentView& around) override {
    Seen& seen = seen_.local();
    look(crowd, grid, around, seen);
    const std::size_t id = around.agent;
    const Eigen::Vector2f& direction = crowd.agents.preferred_direction[id];
    float& perceived = perceived_[id];
    const auto dt_s = static_cast<float>(crowd.dt_s);
    perceived += std::min(1.0F, dt_s / constants_[perception]) * (seen.density.same - perceived);
    const float free_mps = crowd.agents[Property::pref_speed][id];
    const float share = std::min(speed_share(perceived), file_share(crowd, grid, around, free_mps));
    const float speed = std::min(crowd.agents.preferred_speed[id], share * free_mps);
    const Eigen::Vector2f wanted =
        integrate(seen, grid.velocity(around.slot), speed,
                  turned_right(direction, constants_[keep_right], seen.density.oncoming), direction,
                  grid.radius(around.slot), dt_s);
    return kept_off_walls(crowd, grid, around, wanted, seen);
  }

 private:
  static Seen room_for(std::size_t walls) {
    Seen seen;
    seen.planes.reserve(walls);
    seen.scratch.reserve(walls);
    return seen;
  }

  void prepare() override { seen_.prepare(); }

  /// The others, the walls and the density that the agent minds.
  void look(const Crowd& crowd, const Grid& grid, const AgentView& around, Seen& seen) const {
    const Agents& agents = crowd.agents;
    const Eigen::Vector2f& position = grid.position(around.slot);
    const Eigen::Vector2f& direction = agents.preferred_direction[around.agent];
    const float radius = grid.radius(around.slot);
    float reach_sq = constants_[reach] * constants_[reach];
    const auto limit = static_cast<std::size_t>(agents[Property::max_neighbors][around.agent]);
    if (!around.neighbors.empty() && around.neighbors.size() == limit) {
      reach_sq = std::min(reach_sq, around.neighbors.back().distance_sq);
    }
    seen.others.clear();
    float same = 0;
    float all = 0;
    float oncoming = 0;
    float weights = 0;
    float aligned = 0;
    for (const Grid::Neighbor& neighbor : around.neighbors) {
      const std::size_t other = grid.id(neighbor.slot);
      Eigen::Vector2f offset = grid.position(neighbor.slot) - position;
      if (neighbor.distance_sq < kSamePositionSq) {
        // Two in one place part along x, the one with the higher id to the right.
        offset = {around.agent > other ? -kSamePosition : kSamePosition, 0};
      }
      const float cosine = direction.dot(agents.preferred_direction[other]);
      const float alongside = std::clamp(2 * cosine - 1, 0.0F, 1.0F);
      seen.others.push_back({offset, grid.velocity(neighbor.slot),
                             radius + grid.radius(neighbor.slot),
                             1 - (1 - kAlongside) * alongside});
      if (neighbor.distance_sq >= reach_sq) continue;
      const float near = reach_sq - neighbor.distance_sq;
      const float ahead = direction.dot(offset) / std::sqrt(std::max(neighbor.distance_sq, 1e-12F));
      const float weight = near * (1 + ahead) / 2;
      weights += near;
      aligned += near * std::clamp(0.5F + 2.5F * cosine, 0.0F, 1.0F);
      all += weight;
      // Somebody who stands does not walk the same way.
      if (agents.preferred_speed[other] > 0) same += weight * (1 + cosine) / 2;
      if (ahead > 0 && cosine < kOncoming) {
        oncoming += near * ahead * (kOncoming - cosine) / (kOncoming + 1);
      }
    }
    seen.density = {};
    if (weights > 0) {
      // In crossing and opposite flows gaps open and close: the diagram is one of people who walk
      // the same way.
      const float order = aligned / weights;
      const float unit =
          4 / (std::numbers::pi_v<float> * reach_sq * reach_sq);  // of the weights at 1 /m^2
      seen.density.same = order * order * order * same * unit;
      seen.density.others = std::max(0.0F, all * unit - seen.density.same);
      seen.density.oncoming = oncoming * 2 / (reach_sq * reach_sq);
    }
    seen.walls.clear();
    seen.walls.reserve(crowd.obstacles.segments().size());
    for_each_wall(crowd, grid, around, [&](const Segment& wall) {
      const Eigen::Vector2f nearest =
          geometry::nearest_on_segment(wall.begin, wall.end, position) - position;
      const float distance = radius + kWallReachM;
      if (nearest.squaredNorm() < distance * distance) seen.walls.push_back(nearest);
    });
  }

  static float avoided_wall_range_m(float radius, float max_speed) {
    return radius + 2 * kWallHorizonS * std::max(max_speed, 1.0F);
  }

  float wall_range_m(const Crowd& crowd, const Grid& grid, std::size_t slot) const override {
    const float radius = grid.radius(slot);
    const float max_speed = crowd.agents[Property::max_speed][grid.id(slot)];
    return std::max({radius + kWallReachM, kPassingRadii * radius,
                     avoided_wall_range_m(radius, max_speed),
                     wall_reach_m(radius, kWallHorizonS, grid.velocity(slot).norm())});
  }

  /// The nearest velocity that leads into no wall.
  static Eigen::Vector2f kept_off_walls(const Crowd& crowd, const Grid& grid,
                                        const AgentView& around, const Eigen::Vector2f& velocity,
                                        Seen& seen) {
    const float max_speed = crowd.agents[Property::max_speed][around.agent];
    const float reach_m = avoided_wall_range_m(grid.radius(around.slot), max_speed);
    if (around.walls.empty() || around.walls.front().distance_sq > reach_m * reach_m) {
      return velocity;
    }
    seen.planes.clear();
    const Disc self{grid.position(around.slot), grid.velocity(around.slot),
                    grid.radius(around.slot)};
    avoid_walls(self, crowd.obstacles.segments(), around.walls, kWallHorizonS, seen.planes);
    return best_velocity(seen.planes, seen.planes.size(), velocity, max_speed, seen.scratch);
  }

  /// The share of the free speed at a density (1/m²) of people who walk in the same direction.
  float speed_share(float density) const {
    if (density <= 0) return 1;
    const float fall =
        1 / (1 + std::pow(density / constants_[half_density], constants_[steepness]));
    constexpr float kJamDecline = 2;  // 1/m^2
    return std::max(fall, constants_[jam_share] * std::exp(-density / kJamDecline));
  }

  /// The share of the free speed in single file, where speed is at most the gap to the agent ahead
  /// divided by the headway (Seyfried et al. 2005, J. Stat. Mech. P10002).
  float file_share(const Crowd& crowd, const Grid& grid, const AgentView& around,
                   float free_mps) const {
    const float file = around.walls.empty() ? 0 : singleness(crowd, grid, around);
    if (file <= 0 || free_mps <= 0) return 1;
    const float gap = gap_ahead_m(crowd, grid, around) / (constants_[headway] * free_mps);
    return 1 - file * (1 - std::clamp(gap, kCreep, 1.0F));
  }

  /// The mean velocity of a step in which the others go on as they do, but answer what this agent
  /// does.
  Eigen::Vector2f integrate(const Seen& seen, const Eigen::Vector2f& start, float speed,
                            const Eigen::Vector2f& wanted, const Eigen::Vector2f& direction,
                            float radius, float dt_s) const {
    const float max_back = kStepBack * seen.density.others;
    const int steps = std::max(1, static_cast<int>(std::lround(dt_s / kStepS)));
    const float step_s = dt_s / static_cast<float>(steps);
    Eigen::Vector2f velocity = start;
    Eigen::Vector2f moved(0, 0);
    for (int step = 0; step < steps; ++step) {
      const float time_s = step_s * static_cast<float>(step);
      Eigen::Vector2f force = forces(seen, start, velocity, moved, time_s, direction, radius);
      const float size = force.norm();
      if (size > kMaxForce) force *= kMaxForce / size;
      const float limit = std::max({speed, kShuffleMps, velocity.norm()});
      velocity += step_s * ((speed * wanted - velocity) / constants_[relaxation] + force);
      const float now = velocity.norm();
      if (now > limit) velocity *= limit / now;
      const float backward = -velocity.dot(direction);
      if (backward > max_back) velocity += (backward - max_back) * direction;
      moved += step_s * velocity;
    }
    return moved / dt_s;
  }

  Eigen::Vector2f forces(const Seen& seen, const Eigen::Vector2f& start,
                         const Eigen::Vector2f& velocity, const Eigen::Vector2f& moved,
                         float time_s, const Eigen::Vector2f& direction, float radius) const {
    Eigen::Vector2f force(0, 0);
    for (const Other& other : seen.others) {
      // Both give way by as much: without that they would do twice what is needed, and swing.
      const Eigen::Vector2f apart = moved - other.offset - time_s * other.velocity;
      const Eigen::Vector2f offset = apart + (moved - time_s * start).dot(apart) /
                                                 std::max(apart.squaredNorm(), 1e-8F) * apart;
      const float distance = std::sqrt(std::max(offset.squaredNorm(), 1e-8F));
      const Eigen::Vector2f away = offset / distance;
      const Eigen::Vector2f relative =
          velocity - other.velocity + away.dot(velocity - start) * away;
      if (distance < other.touch) force += kContact * (other.touch - distance) * away;
      const float in_view = -direction.dot(away) < kView ? kBehind : 1.0F;
      // Discs that touch already avoid coming nearer.
      constexpr float kNotYet = 0.98F;
      force += in_view * other.weight *
               avoidance(offset, distance, relative, std::min(other.touch, kNotYet * distance),
                         constants_[strength], constants_[horizon]);
    }
    for (const Eigen::Vector2f& wall : seen.walls) {
      const Eigen::Vector2f offset = moved - wall;
      const float distance = std::max(offset.norm(), 1e-4F);
      force += kWall * std::exp((radius - distance) / kWallRangeM) / distance * offset;
    }
    return force;
  }

  const std::vector<float>& constants_;
  PerThread<Seen> seen_;
  std::vector<float> perceived_;  // density of people who walk the same way, by agent, 1/m^2
};

std::unique_ptr<Model> make_ttc(const Crowd& crowd) {
  return std::make_unique<TimeToCollision>(crowd);
}

}  // namespace

ModelEntry ttc_model() {
  return {"ttc",
          "TimeToCollision",
          "time-to-collision power law (Karamouzas, Skinner and Guy 2014) with a fundamental "
          "diagram of people who walk "
          "the same way: lanes and crossings flow, doors and dense crowds have the flows of "
          "experiments",
          {},
          {{"strength", 1.5F, 0, 100, "of the avoidance of collisions, in m^2"},
           {"horizon", 3, 0.01F, 100, "time to a collision over which avoidance fades, in s"},
           {"relaxation", 0.3F, 0.01F, 10, "in which the preferred velocity is taken, in s"},
           {"reach", 2.5F, 0.1F, 100, "how far away others count as density, in m"},
           {"half_density", 1.8F, 0.1F, 100,
            "at which people walk at half of their free speed, per m^2"},
           {"steepness", 8, 0.1F, 100, "exponent of the fall of speed with density"},
           {"jam_share", 0.6F, 0, 1,
            "times exp(-density / 2): share of the free speed that is left in a jam"},
           {"perception", 1, 0.01F, 100, "over which density is averaged, in s"},
           {"keep_right", 2, 0, 100,
            "how far one turns right from those who come towards one, in rad m^2"},
           {"headway", 0.85F, 0.01F, 100, "time to the one ahead in single file, in s"}},
          make_ttc};
}

}  // namespace throng::crowd
