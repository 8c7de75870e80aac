#include <algorithm>
#include <limits>
#include <optional>

#include "crowd/models/orca_batch.h"
#include "crowd/models/orca_lines.h"
#include "crowd/models/pace.h"
#include "crowd/models/single_file.h"
#include "crowd/state/model.h"
#include "crowd/state/neighborhood.h"

namespace throng::crowd {

namespace {

enum Parameter : std::size_t { tau, tau_obstacles };

/// Buffers of one thread; kept from step to step, so that a step allocates nothing.
struct Workspace {
  OrcaBatch batch;
  HalfPlanes walls;
  PaceBatch paces;
};

class Orca : public Model {
 public:
  Orca(const Crowd& crowd, std::optional<Pace> pace)
      : pace_(pace),
        neighborhood_(crowd),
        solve_(OrcaBatch::kernel(crowd.instruction_set)),
        look_ahead_(PaceBatch::kernel(crowd.instruction_set)),
        workspaces_(make_workspace(crowd)) {}

  void step(const Crowd& crowd, const Grid& grid,
            std::span<Eigen::Vector2f> new_velocity) override {
    neighborhood_.prepare(crowd, grid);
    workspaces_.prepare();
    if (pace_) sort_directions(crowd, grid);
    parallel_ranges(grid.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Workspace& workspace = workspaces_.local();
      for (std::size_t slot = begin; slot < end; slot += OrcaBatch::kAgents) {
        step_batch(crowd, grid, slot, std::min(slot + OrcaBatch::kAgents, end), workspace,
                   new_velocity);
      }
    });
  }

 private:
  static constexpr std::size_t kGrain = 64;  // agents per task

  static Workspace make_workspace(const Crowd& crowd) {
    const std::vector<float>& max_neighbors = crowd.agents[Property::max_neighbors];
    const auto neighbors = max_neighbors.empty() ? 0
                                                 : static_cast<std::size_t>(*std::max_element(
                                                       max_neighbors.begin(), max_neighbors.end()));
    const std::size_t walls = crowd.obstacles.segments().size();
    Workspace workspace{OrcaBatch(neighbors, walls), {}, {}};
    workspace.walls.reserve(walls);
    return workspace;
  }

  void step_batch(const Crowd& crowd, const Grid& grid, std::size_t begin, std::size_t end,
                  Workspace& workspace, std::span<Eigen::Vector2f> new_velocity) {
    workspace.batch.clear();
    for (std::size_t slot = begin; slot < end; ++slot) {
      add(crowd, grid, neighborhood_.look(crowd, grid, slot, wall_range_m(crowd, grid, slot)),
          workspace);
    }
    if (pace_) {
      look_ahead_(grid, directions_, workspace.batch.seen(), workspace.paces);
      for (std::size_t slot = begin; slot < end; ++slot) {
        slow_down(crowd.agents, grid.id(slot), slot - begin, workspace);
      }
    }
    solve_(grid, static_cast<float>(crowd.dt_s), workspace.batch);
    for (std::size_t slot = begin; slot < end; ++slot) {
      new_velocity[grid.id(slot)] = workspace.batch.velocity(slot - begin);
    }
  }

  /// Farther walls forbid nothing. Menge searches all that an agent sees.
  float wall_range_m(const Crowd& crowd, const Grid& grid, std::size_t slot) const {
    if (crowd.compat != Compat::none) return std::numeric_limits<float>::infinity();
    const std::size_t id = grid.id(slot);
    const float radius = grid.radius(slot);
    const float speed = std::max(crowd.agents[Property::max_speed][id], grid.velocity(slot).norm());
    const float reach =
        wall_reach_m(radius, crowd.agents.model_parameters[tau_obstacles][id], speed);
    return pace_ ? std::max(reach, kPassingRadii * radius) : reach;
  }

  void add(const Crowd& crowd, const Grid& grid, const AgentView& around,
           Workspace& workspace) const {
    const Agents& agents = crowd.agents;
    const std::size_t id = around.agent;
    workspace.walls.clear();
    if (!around.walls.empty()) {
      const Disc self{grid.position(around.slot), grid.velocity(around.slot),
                      grid.radius(around.slot)};
      avoid_walls(self, crowd.obstacles.segments(), around.walls,
                  agents.model_parameters[tau_obstacles][id], workspace.walls);
    }
    if (pace_) {
      workspace.paces.set(workspace.batch.size(), pace_->view(crowd, grid, around));
    }
    workspace.batch.add({around.slot, agents.model_parameters[tau][id],
                         agents.preferred_speed[id] * agents.preferred_direction[id],
                         agents[Property::max_speed][id]},
                        workspace.walls, around.neighbors);
  }

  /// Sorts preferred directions into the grid's order, because neighbors read each other's.
  void sort_directions(const Crowd& crowd, const Grid& grid) {
    constexpr std::size_t kDirectionGrain = 4096;
    if (directions_.size() < grid.size()) directions_.resize(grid.size());
    parallel_ranges(grid.size(), kDirectionGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t slot = begin; slot < end; ++slot) {
        directions_[slot] = crowd.agents.preferred_direction[grid.id(slot)];
      }
    });
  }

  void slow_down(const Agents& agents, std::size_t id, std::size_t lane,
                 Workspace& workspace) const {
    const Pace::View& view = workspace.paces.view(lane);
    const SpeedRegulation regulation = pace_->regulation(view, workspace.paces.ahead(lane));
    const float speed = std::min(agents.preferred_speed[id], regulation.share * view.free_speed);
    workspace.batch.set_wish(lane, agents.model_parameters[tau][id] * regulation.horizon_share,
                             speed * regulation.direction);
  }

  std::optional<Pace> pace_;  // of those who slow down where it is crowded
  Neighborhood neighborhood_;
  OrcaBatch::Kernel* solve_;
  PaceBatch::Kernel* look_ahead_;
  std::vector<Eigen::Vector2f> directions_;  // per slot of the grid, for pace_
  PerThread<Workspace> workspaces_;
};

std::unique_ptr<Model> make_orca(const Crowd& crowd) {
  return std::make_unique<Orca>(crowd, std::nullopt);
}

std::unique_ptr<Model> make_weidmann(const Crowd& crowd) {
  const std::vector<float>& c = crowd.model_constants;
  return std::make_unique<Orca>(crowd, Pace({c[0], c[1], c[2], c[3], c[4], c[5]}));
}

}  // namespace

ModelEntry orca_model() {
  return {"orca",
          "ORCA",
          "optimal reciprocal collision avoidance (van den Berg et al. 2011)",
          {{"tau", 2.5F, 1e-3F, 1000, "how long moves stay free of others, in s"},
           {"tauObst", 0.15F, 1e-3F, 1000, "how long moves stay free of walls, in s"}},
          {},
          make_orca};
}

ModelEntry weidmann_model() {
  const PaceSpec pace;
  return {"weidmann",
          "Weidmann",
          "orca, slower where it is crowded ahead, keeping right in counter-flow: calibrated to "
          "the fundamental diagram of Weidmann "
          "(1993) and the flow through doors",
          {{"tau", 0.51F, 1e-3F, 1000,
            "how long moves stay free of others, in s; less where speed is less"},
           {"tauObst", 0.15F, 1e-3F, 1000, "how long moves stay free of walls, in s"}},
          {{"reach", pace.reach_m, 0.1F, 100, "how far ahead others count, in m"},
           {"jam_density", pace.jam_density, 0.1F, 100, "at which nobody would walk, per m^2"},
           {"decline", pace.decline, 0.01F, 100, "how late speed falls with density, per m^2"},
           {"least", pace.min_speed_share, 0, 1, "share of the free speed that is left in a jam"},
           {"headway", pace.headway_s, 0.01F, 100, "time to the one ahead in single file, in s"},
           {"keep_right", pace.keep_right, 0, 100,
            "how far one turns right from those who come towards one, in rad m^2"}},
          make_weidmann};
}

}  // namespace throng::crowd
