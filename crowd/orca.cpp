#include <algorithm>

#include "crowd/model.h"
#include "crowd/neighborhood.h"
#include "crowd/orca_lines.h"

namespace throng::crowd {

namespace {

enum Parameter : std::size_t { tau, tau_obstacles };

/// What one thread works with; kept from step to step, so that a step allocates nothing.
struct Workspace {
  HalfPlanes planes;
  HalfPlanes scratch;
};

class Orca : public Model {
 public:
  explicit Orca(const Crowd& crowd)
      : neighborhood_(crowd),
        avoid_discs_(avoid_discs(crowd.instruction_set)),
        workspaces_(make_workspace(crowd)) {}

  void step(const Crowd& crowd, const Grid& grid,
            std::span<Eigen::Vector2f> new_velocity) override {
    workspaces_.prepare();
    neighborhood_.for_each(crowd, grid, [&](const Surroundings& around) {
      new_velocity[around.agent] = velocity(crowd, grid, around, workspaces_.local());
    });
  }

 private:
  static Workspace make_workspace(const Crowd& crowd) {
    const std::vector<float>& most = crowd.agents[Property::max_neighbors];
    const auto neighbors =
        most.empty() ? 0 : static_cast<std::size_t>(*std::max_element(most.begin(), most.end()));
    const std::size_t walls = crowd.obstacles.segments().size();
    Workspace workspace;
    workspace.planes.reserve(neighbors + walls);
    workspace.scratch.reserve(neighbors + walls);
    return workspace;
  }

  Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid, const Surroundings& around,
                           Workspace& workspace) const {
    const Agents& agents = crowd.agents;
    const std::size_t id = around.agent;
    HalfPlanes& planes = workspace.planes;
    planes.clear();
    if (!around.walls.empty()) {
      const Disc self{grid.position(around.slot), grid.velocity(around.slot),
                      grid.radius(around.slot)};
      avoid_walls(self, crowd.obstacles.segments(), around.walls,
                  agents.model_parameters[tau_obstacles][id], planes);
    }
    const std::size_t walls = planes.size();
    avoid_discs_(grid, around.slot, around.neighbors, agents.model_parameters[tau][id],
                 static_cast<float>(crowd.dt_s), planes);
    const Eigen::Vector2f preferred = agents.preferred_speed[id] * agents.preferred_direction[id];
    return best_velocity(planes, walls, preferred, agents[Property::max_speed][id],
                         workspace.scratch, crowd.instruction_set);
  }

  Neighborhood neighborhood_;
  AvoidDiscs* avoid_discs_;
  PerThread<Workspace> workspaces_;
};

std::unique_ptr<Model> make_orca(const Crowd& crowd) { return std::make_unique<Orca>(crowd); }

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

}  // namespace throng::crowd
