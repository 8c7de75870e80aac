#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "base/parallel.h"
#include "crowd/model.h"
#include "crowd/orca_lines.h"

namespace throng::crowd {

namespace {

enum Parameter : std::size_t { tau, tau_obstacles };

constexpr std::size_t kAvoidanceGrain = 64;  // agents per task

/// What one thread works with; kept from step to step, so that a step allocates nothing.
struct Workspace {
  std::vector<Grid::Neighbor> neighbors;
  std::vector<Obstacles::Near> walls;
  std::vector<HalfPlane> planes;
  std::vector<HalfPlane> scratch;
};

class Orca : public Model {
 public:
  explicit Orca(const Crowd& crowd)
      : reach_(crowd.agents.count(), kFirstReach), workspaces_(make_workspace(crowd)) {}

  void step(const Crowd& crowd, const Grid& grid,
            std::span<Eigen::Vector2f> new_velocity) override {
    parallel_ranges(grid.size(), kAvoidanceGrain, [&](std::size_t begin, std::size_t end) {
      Workspace& workspace = workspaces_.local();
      for (std::size_t slot = begin; slot < end; ++slot) {
        new_velocity[grid.id(slot)] = velocity(crowd, grid, slot, workspace);
      }
    });
  }

 private:
  static constexpr float kFirstReach = 2;  // m

  static Workspace make_workspace(const Crowd& crowd) {
    const std::vector<float>& most = crowd.agents[Property::max_neighbors];
    const auto neighbors =
        most.empty() ? 0 : static_cast<std::size_t>(*std::max_element(most.begin(), most.end()));
    const std::size_t walls = crowd.obstacles.segments().size();
    Workspace workspace;
    workspace.neighbors.resize(neighbors);
    workspace.walls.reserve(walls);
    workspace.planes.reserve(neighbors + walls);
    workspace.scratch.reserve(neighbors + walls);
    return workspace;
  }

  Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid, std::size_t slot,
                           Workspace& workspace) {
    const Agents& agents = crowd.agents;
    const std::size_t id = grid.id(slot);
    const float range = agents[Property::neighbor_dist][id];
    const Disc self{grid.position(slot), grid.velocity(slot), grid.radius(slot)};

    workspace.planes.clear();
    crowd.obstacles.near(self.position, range, agents.obstacle_mask[id], workspace.walls);
    avoid_walls(self, crowd.obstacles.segments(), workspace.walls,
                agents.model_parameters[tau_obstacles][id], workspace.planes);
    const std::size_t walls = workspace.planes.size();

    const auto most = static_cast<std::size_t>(agents[Property::max_neighbors][id]);
    const std::size_t count =
        grid.nearest(slot, range, std::span(workspace.neighbors).first(most), reach_[id]);
    const float horizon_s = agents.model_parameters[tau][id];
    for (std::size_t i = 0; i < count; ++i) {
      const Grid::Neighbor& neighbor = workspace.neighbors[i];
      Disc other{grid.position(neighbor.slot), grid.velocity(neighbor.slot),
                 grid.radius(neighbor.slot)};
      // Two in one place part along x, the one with the higher id to the right.
      constexpr float kNudge = 1e-3F;  // m
      if (neighbor.distance_sq == 0) {
        other.position.x() += grid.id(neighbor.slot) > id ? kNudge : -kNudge;
      }
      workspace.planes.push_back(
          avoid_disc(self, other, horizon_s, static_cast<float>(crowd.dt_s)));
    }
    const Eigen::Vector2f preferred = agents.preferred_speed[id] * agents.preferred_direction[id];
    return best_velocity(workspace.planes, walls, preferred, agents[Property::max_speed][id],
                         workspace.scratch);
  }

  std::vector<float> reach_;  // per agent, see Grid::nearest
  tbb::enumerable_thread_specific<Workspace> workspaces_;
};

std::unique_ptr<Model> make_orca(const Crowd& crowd) { return std::make_unique<Orca>(crowd); }

}  // namespace

ModelEntry orca_model() {
  return {"orca",
          "ORCA",
          "optimal reciprocal collision avoidance (van den Berg et al. 2011)",
          {{"tau", 2.5F, 1e-3F, 1000, "how long moves stay free of others, in s"},
           {"tauObst", 0.15F, 1e-3F, 1000, "how long moves stay free of walls, in s"}},
          make_orca};
}

}  // namespace throng::crowd
