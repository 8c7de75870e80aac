#include "crowd/models/fundamental_diagram.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"
#include "crowd/models/local_model.h"

namespace throng::crowd {

namespace {

constexpr float kPi = 3.14159265F;
constexpr float kAhead = 1;  // m
constexpr float kAsideStretch = 2.5F;

float bell(float distance_sq, float sigma) { return std::exp(-distance_sq / (2 * sigma * sigma)); }

}  // namespace

// Evaluated at the positions in Menge's series of the bottleneck, this gives the preferred speeds
// recorded there to the last digit: agents behind the place count as well as those before it, a
// wall counts at its point nearest to the place, not stretched, and with the agents' factor.
float density_ahead(const Crowd& crowd, const Grid& grid, const AgentView& around,
                    const Eigen::Vector2f& direction, const DensityKernel& kernel) {
  const Eigen::Vector2f& position = grid.position(around.slot);
  const Eigen::Vector2f place = position + kAhead * direction;
  float sum = 0;
  for (const Grid::Neighbor& neighbor : around.neighbors) {
    const Eigen::Vector2f offset = grid.position(neighbor.slot) - place;
    const float along = direction.dot(offset);
    const float aside = kAsideStretch * geometry::cross(direction, offset);
    sum += bell(along * along + aside * aside, kernel.agents);
  }
  const std::vector<Segment>& segments = crowd.obstacles.segments();
  for (const Obstacles::Near& near : around.walls) {
    const Segment& wall = segments[near.segment];
    if (is_shared_corner(segments, wall, place)) continue;
    const Eigen::Vector2f nearest = geometry::nearest_on_segment(wall.begin, wall.end, place);
    if (direction.dot(nearest - position) <= 0) continue;
    sum += bell((nearest - place).squaredNorm(), kernel.walls);
  }
  return sum / (kernel.agents * std::sqrt(2 * kPi));
}

float speed_at_density(float density, const Stride& stride) {
  constexpr float kMinDensity = 0.001F;
  constexpr float kRoom = 0.48F;  // persons
  constexpr float kPlenty = 100;  // m
  const float space = density < kMinDensity ? kPlenty : kRoom / density;
  const float stretch = 0.5F * (1 + stride.buffer) / stride.factor;
  return space / stretch * (space / stretch);
}

namespace {

/// Knows who sees whom at the beginning of a step.
class Lookout : public Process {
 public:
  explicit Lookout(const Crowd& crowd) : neighborhood_(crowd) {}

  void before_decisions(Crowd& crowd, Machine&) override {
    grid_.build(crowd.agents);
    slots_.assign(crowd.agents.count(), kNone);
    for (std::size_t slot = 0; slot < grid_.size(); ++slot) {
      slots_[grid_.id(slot)] = static_cast<std::int64_t>(slot);
    }
    neighborhood_.prepare(crowd, grid_);
  }

  bool knows(std::size_t agent) const { return agent < slots_.size() && slots_[agent] != kNone; }
  const Grid& grid() const { return grid_; }
  AgentView look(const Crowd& crowd, std::size_t agent) {
    return neighborhood_.look(crowd, grid_, static_cast<std::size_t>(slots_[agent]));
  }

 private:
  static constexpr std::int64_t kNone = -1;

  Grid grid_;
  std::vector<std::int64_t> slots_;  // by id
  Neighborhood neighborhood_;
};

class SlowByDensity : public VelModifier {
 public:
  SlowByDensity(Lookout& lookout, const DensityKernel& kernel, std::vector<Stride> strides)
      : lookout_(lookout), kernel_(kernel), strides_(std::move(strides)) {}

  void modify(const Crowd& crowd, std::size_t agent, PreferredVelocity& preferred) const override {
    if (!lookout_.knows(agent)) return;
    const float density = density_ahead(crowd, lookout_.grid(), lookout_.look(crowd, agent),
                                        preferred.direction, kernel_);
    preferred.speed = std::min(preferred.speed, speed_at_density(density, strides_[agent]));
  }

 private:
  Lookout& lookout_;
  DensityKernel kernel_;
  std::vector<Stride> strides_;
};

std::unique_ptr<VelModifier> make_slow_by_density(const Element&, const Attributes& attributes,
                                                  BehaviorContext& context) {
  Sampler factor = context.make_sampler(attributes.distribution("factor_"));
  Sampler buffer = context.make_sampler(attributes.distribution("buffer_"));
  std::vector<Stride> strides(context.agent_count);
  for (std::size_t agent = 0; agent < strides.size(); ++agent) {
    constexpr float kMinFactor = 1e-3F;
    strides[agent].factor = std::max(static_cast<float>(factor(agent, 0)), kMinFactor);
    strides[agent].buffer = std::max(static_cast<float>(buffer(agent, 0)), 0.0F);
  }
  DensityKernel kernel{attributes.real("sigma_agent"), attributes.real("sigma_obstacle")};
  // Menge's modifiers lose it when they are copied, as they are for each profile.
  if (context.crowd.compat != Compat::none) kernel.walls = kernel.agents;
  auto lookout = std::make_unique<Lookout>(context.crowd);
  auto modifier = std::make_unique<SlowByDensity>(*lookout, kernel, std::move(strides));
  context.processes.push_back(std::move(lookout));
  return modifier;
}

}  // namespace

std::vector<VelModifierRegistry::Entry> density_modifiers() {
  return {
      {"fundamental_diagram",
       "slower where it is crowded (Curtis and Manocha 2014); with Menge's quirks sigma_obstacle "
       "is sigma_agent",
       {distribution("factor_", "stature: the higher, the shorter the strides at a speed", 0.01,
                     100),
        distribution("buffer_", "room before and behind a stride, of its length", 0, 100),
        optional(number("sigma_agent", "how far others count, in m", 0.01, 100), "1.5"),
        optional(number("sigma_obstacle", "how far walls count, in m", 0.01, 100), "0.75")},
       make_slow_by_density},
  };
}

}  // namespace throng::crowd
