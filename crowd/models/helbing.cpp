#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"
#include "crowd/models/disc_lanes.h"
#include "crowd/models/lane_batch.h"
#include "crowd/models/local_model.h"
#include "crowd/state/model.h"

namespace throng::crowd {

namespace {

enum Parameter : std::size_t { mass };
enum Constant : std::size_t {
  agent_scale,
  obstacle_scale,
  reaction_time,
  body_force,
  friction,
  force_distance
};

constexpr float kStrongest = 1e15F;  // N

/// Buffers of one thread.
struct Workspace {
  LaneBatch agents{0};
  LaneBatch::Lanes force_x{};  // between bodies, N
  LaneBatch::Lanes force_y{};
};

/// A force between two bodies, or between a body and a wall, per lane.
template <typename Float>
struct ForceLanes {
  Float push;   ///< along the normal, away from the other
  Float shear;  ///< along the tangent
};

/// `inside` is by how much they overlap, m; `sliding` how fast the other moves along the tangent.
template <typename Float>
ForceLanes<Float> contact_force(const Float& overlap, const Float& tangential, float scale,
                                const Float& distance, float stiffness, float friction_k) {
  const Float touching = overlap > 0 ? overlap : Float{};
  const Float push = scale * exponential(overlap / distance) + stiffness * touching;
  return {push < kStrongest ? push : Float{} + kStrongest, friction_k * touching * tangential};
}

/// Values of the step that the forces depend on.
struct Setting {
  const Crowd& crowd;
  const Grid& grid;
  bool right_of_way = false;  ///< somebody has it
};

/// The forces from other people on the agents of a batch.
struct CrowdForceKernel {
  template <int kWidth>
  using Float = typename Vectors<kWidth>::Float;

  template <int kWidth>
  static void run(const Setting& setting, Workspace& work) {
    work.agents.fill();
    for (std::size_t first = 0; first < work.agents.size(); first += kWidth) {
      lanes<kWidth>(setting, first, work);
    }
  }

  /// How forces between two are directed, per lane.
  template <int kWidth>
  struct Normals {
    Float<kWidth> x;  // unit, away from the other
    Float<kWidth> y;
    Float<kWidth> reach;  // in which the repulsion falls to 1/e, m
  };

  template <int kWidth>
  static void lanes(const Setting& setting, std::size_t first, Workspace& work) {
    const std::vector<float>& constants = setting.crowd.model_constants;
    const LaneBatch& agents = work.agents;
    const bool unsigned_friction = setting.crowd.compat != Compat::none;
    const auto self = discs_in<kWidth>(setting.grid, &agents.slots()[first]);
    const Float<kWidth> count = load<kWidth>(&agents.neighbors()[first]);
    Float<kWidth> force_x{};
    Float<kWidth> force_y{};
    for (std::size_t i = 0; i < agents.rows(); ++i) {
      const auto there = count > static_cast<float>(i);
      const auto others = agents.row<kWidth>(i, first);
      const auto other = discs_in<kWidth>(setting.grid, others.data());
      const Float<kWidth> x = self.x - other.x;
      const Float<kWidth> y = self.y - other.y;
      const Float<kWidth> separation = square_root<kWidth>(x * x + y * y);
      // Two agents in one place: the one with the lower id has the other on its right.
      const auto together = separation == 0;
      Normals<kWidth> normals{together ? Float<kWidth>{} + 1 : x / separation,
                              together ? Float<kWidth>{} : y / separation,
                              broadcast<kWidth>(constants[force_distance])};
      if (any(there & together)) {
        part<kWidth>(setting, &agents.slots()[first], others.data(), normals);
      }
      if (setting.right_of_way) {
        give_way<kWidth>(setting, &agents.slots()[first], others.data(), normals);
      }
      const Float<kWidth> along =
          (other.vx - self.vx) * normals.y - (other.vy - self.vy) * normals.x;
      const Float<kWidth> tangential = unsigned_friction ? (along < 0 ? -along : along) : along;
      const auto force = contact_force<Float<kWidth>>(
          self.radius + other.radius - separation, tangential, constants[agent_scale],
          normals.reach, constants[body_force], constants[friction]);
      force_x += there ? force.push * normals.x + force.shear * normals.y : Float<kWidth>{};
      force_y += there ? force.push * normals.y - force.shear * normals.x : Float<kWidth>{};
    }
    store(force_x, &work.force_x[first]);
    store(force_y, &work.force_y[first]);
  }

  template <int kWidth>
  static void part(const Setting& setting, const std::uint32_t* slots, const std::uint32_t* others,
                   Normals<kWidth>& normals) {
    const Grid& grid = setting.grid;
    for (std::size_t i = 0; i < kWidth; ++i) {
      if (grid.position(slots[i]) != grid.position(others[i])) continue;
      if (grid.id(slots[i]) < grid.id(others[i])) normals.x[i] = -1;
    }
  }

  /// An agent that has to yield to another notices it from farther away, and is pushed more to the
  /// side of its preferred direction (Curtis et al. 2013).
  template <int kWidth>
  static void give_way(const Setting& setting, const std::uint32_t* slots,
                       const std::uint32_t* others, Normals<kWidth>& normals) {
    const Agents& agents = setting.crowd.agents;
    for (std::size_t i = 0; i < kWidth; ++i) {
      const std::uint32_t id = setting.grid.id(slots[i]);
      const std::uint32_t other = setting.grid.id(others[i]);
      const float right =
          std::min(1.0F, agents[Property::priority][other] - agents[Property::priority][id]);
      if (!(right > 0)) continue;
      normals.reach[i] += 0.5F * right * right * setting.grid.radius(slots[i]);
      if (agents.preferred_speed[other] == 0) continue;
      const Eigen::Vector2f normal(normals.x[i], normals.y[i]);
      const Eigen::Vector2f turned = turned_aside(normal, agents.preferred_direction[other], right);
      normals.x[i] = turned.x();
      normals.y[i] = turned.y();
    }
  }

  /// `normal` turned by a share of the angle to the nearer of the perpendiculars of a direction.
  static Eigen::Vector2f turned_aside(const Eigen::Vector2f& normal,
                                      const Eigen::Vector2f& direction, float share) {
    const Eigen::Vector2f left(-direction.y(), direction.x());
    const Eigen::Vector2f aside = normal.dot(left) >= 0 ? left : Eigen::Vector2f(-left);
    const float angle = share * std::atan2(geometry::cross(normal, aside), normal.dot(aside));
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    return {c * normal.x() - s * normal.y(), s * normal.x() + c * normal.y()};
  }
};

/// An agent beyond a wall's end is pushed by the next wall, which begins there.
bool nearest_to_end(const Segment& wall, const Eigen::Vector2f& position) {
  return wall.direction.dot(position - wall.end) >= 0;
}

/// Social forces between people and from walls, with pressure and friction where they touch
/// (Helbing, Farkas and Vicsek 2000), with right of way as Curtis et al. (2013) have it.
class Helbing : public Model {
 public:
  explicit Helbing(const Crowd& crowd)
      : neighborhood_(crowd),
        crowd_forces_(Versions<CrowdForceKernel, void(const Setting&, Workspace&)>::pick(
            crowd.instruction_set)),
        workspaces_(Workspace{}) {}

  void step(const Crowd& crowd, const Grid& grid,
            std::span<Eigen::Vector2f> new_velocity) override {
    const std::vector<float>& priority = crowd.agents[Property::priority];
    const bool right_of_way =
        std::any_of(priority.begin(), priority.end(), [](float value) { return value != 0; });
    const Setting setting{crowd, grid, right_of_way};
    neighborhood_.prepare(crowd, grid);
    workspaces_.prepare();
    parallel_ranges(grid.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Workspace& work = workspaces_.local();
      for (std::size_t slot = begin; slot < end; slot += LaneBatch::kAgents) {
        step_batch(setting, slot, std::min(slot + LaneBatch::kAgents, end), work, new_velocity);
      }
    });
  }

 private:
  static constexpr std::size_t kGrain = 64;  // agents per task

  void step_batch(const Setting& setting, std::size_t begin, std::size_t end, Workspace& work,
                  std::span<Eigen::Vector2f> new_velocity) {
    std::array<Eigen::Vector2f, LaneBatch::kAgents> forces;
    work.agents.clear();
    for (std::size_t slot = begin; slot < end; ++slot) {
      const AgentView around = neighborhood_.look(setting.crowd, setting.grid, slot);
      forces[slot - begin] = drive(setting.crowd, around.agent);
      for (const Obstacles::Near& near : around.walls) {
        forces[slot - begin] +=
            push(setting, slot, setting.crowd.obstacles.segments()[near.segment]);
      }
      work.agents.add(slot, around.neighbors);
    }
    crowd_forces_(setting, work);
    for (std::size_t slot = begin; slot < end; ++slot) {
      const std::size_t lane = slot - begin;
      const std::size_t id = setting.grid.id(slot);
      const Eigen::Vector2f between(work.force_x[lane], work.force_y[lane]);
      const float rate = static_cast<float>(setting.crowd.dt_s) / inertia(setting.crowd, id);
      new_velocity[id] = possible_velocity(
          setting.crowd, id, setting.grid.velocity(slot) + rate * (forces[lane] + between));
    }
  }

  static float inertia(const Crowd& crowd, std::size_t id) {
    return crowd.agents.model_parameters[mass][id];
  }

  /// Towards the preferred velocity.
  static Eigen::Vector2f drive(const Crowd& crowd, std::size_t id) {
    const Agents& agents = crowd.agents;
    const Eigen::Vector2f wanted = agents.preferred_speed[id] * agents.preferred_direction[id];
    const float rate = inertia(crowd, id) / crowd.model_constants[reaction_time];
    return rate * (wanted - agents.velocity[id]);
  }

  static Eigen::Vector2f push(const Setting& setting, std::size_t slot, const Segment& wall) {
    const Eigen::Vector2f& position = setting.grid.position(slot);
    if (nearest_to_end(wall, position)) return Eigen::Vector2f::Zero();
    const std::vector<float>& constants = setting.crowd.model_constants;
    const Eigen::Vector2f offset =
        position - geometry::nearest_on_segment(wall.begin, wall.end, position);
    const float distance = offset.norm();
    const Eigen::Vector2f normal =
        unit_or(offset, Eigen::Vector2f(wall.direction.y(), -wall.direction.x()));
    const Eigen::Vector2f tangent(normal.y(), -normal.x());
    const auto force =
        contact_force<float>(setting.grid.radius(slot) - distance,
                             -setting.grid.velocity(slot).dot(tangent), constants[obstacle_scale],
                             constants[force_distance], constants[body_force], constants[friction]);
    return force.push * normal + force.shear * tangent;
  }

  Neighborhood neighborhood_;
  void (*crowd_forces_)(const Setting&, Workspace&);
  PerThread<Workspace> workspaces_;
};

std::unique_ptr<Model> make_helbing(const Crowd& crowd) { return std::make_unique<Helbing>(crowd); }

}  // namespace

ModelEntry helbing_model() {
  return {"helbing",
          "Helbing",
          "social forces with pressure and friction (Helbing, Farkas and Vicsek 2000)",
          {{"mass", 80, 1e-3F, 1e6F, "in kg"}},
          {{"agent_scale", 2000, 0, 1e9F, "repulsion of people who touch, in N"},
           {"obstacle_scale", 2000, 0, 1e9F, "repulsion of walls that are touched, in N"},
           {"reaction_time", 0.5F, 1e-3F, 1000, "to reach the preferred velocity, in s"},
           {"body_force", 1.2e5F, 0, 1e9F, "stiffness of bodies, in N/m"},
           {"friction", 2.4e5F, 0, 1e9F, "between bodies, in kg/(m s)"},
           {"force_distance", 0.08F, 1e-4F, 100, "in which repulsion falls to 1/e, in m"}},
          make_helbing};
}

}  // namespace throng::crowd
