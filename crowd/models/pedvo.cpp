#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"
#include "crowd/models/fundamental_diagram.h"
#include "crowd/models/local_model.h"
#include "crowd/models/orca_lines.h"

namespace throng::crowd {

namespace {

enum Parameter : std::size_t { tau, tau_obstacles, turning_bias, factor, buffer, density_aware };

/// Buffers of one thread; kept from step to step, so that a step allocates nothing.
struct Workspace {
  HalfPlanes planes;
  HalfPlanes scratch;
};

Workspace make_workspace(const Crowd& crowd) {
  const std::vector<float>& max_neighbors = crowd.agents[Property::max_neighbors];
  const auto neighbors =
      max_neighbors.empty()
          ? 0
          : static_cast<std::size_t>(*std::max_element(max_neighbors.begin(), max_neighbors.end()));
  Workspace workspace;
  workspace.planes.reserve(neighbors + crowd.obstacles.segments().size());
  workspace.scratch.reserve(neighbors + crowd.obstacles.segments().size());
  return workspace;
}

/// Makes turning as cheap as changing speed when what is aside of a direction is divided by the
/// bias: above 1, people rather turn.
class Bias {
 public:
  Bias(const Eigen::Vector2f& direction, float bias) : direction_(direction), bias_(bias) {}

  Eigen::Vector2f apply(const Eigen::Vector2f& v) const { return scale_aside(v, 1 / bias_); }
  Eigen::Vector2f undo(const Eigen::Vector2f& v) const { return scale_aside(v, bias_); }
  bool is_none() const { return bias_ == 1; }

 private:
  Eigen::Vector2f scale_aside(const Eigen::Vector2f& v, float scale) const {
    return direction_.dot(v) * direction_ +
           scale * geometry::cross(direction_, v) * turn_left(direction_);
  }

  Eigen::Vector2f direction_;
  float bias_;
};

/// ORCA with strides that need room, right of way and a bias for turning (Curtis and Manocha 2014;
/// Curtis et al. 2013).
class PedVo : public LocalModel {
 public:
  explicit PedVo(const Crowd& crowd)
      : LocalModel(crowd),
        avoid_discs_(avoid_discs(crowd.instruction_set)),
        workspaces_(make_workspace(crowd)) {}

 protected:
  void prepare() override { workspaces_.prepare(); }

  Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid, const AgentView& around) override {
    const Walker self(crowd, grid, around.slot);
    const Disc disc{self.position, self.velocity, self.radius};
    Workspace& workspace = workspaces_.local();
    HalfPlanes& planes = workspace.planes;
    planes.clear();
    avoid_walls(disc, crowd.obstacles.segments(), around.walls,
                parameter(crowd, tau_obstacles, self), planes);
    const std::size_t walls = planes.size();
    avoid_discs_(grid, around.slot, around.neighbors, parameter(crowd, tau, self),
                 static_cast<float>(crowd.dt_s), planes);
    apply_right_of_way(crowd, grid, around, disc, walls, planes);
    const Bias bias(self.preferred_direction, parameter(crowd, turning_bias, self));
    for (std::size_t i = 0; i < planes.size() && !bias.is_none(); ++i) {
      planes.set(i, {bias.apply(planes[i].point), bias.apply(planes[i].direction).normalized()});
    }
    const Eigen::Vector2f preferred =
        preferred_speed(crowd, grid, around, self) * self.preferred_direction;
    const Eigen::Vector2f best = best_velocity(
        planes, walls, preferred, crowd.agents[Property::max_speed][self.id], workspace.scratch);
    return bias.is_none() ? best : bias.undo(best);
  }

 private:
  static float parameter(const Crowd& crowd, Parameter which, const Walker& walker) {
    return crowd.agents.model_parameters[which][walker.id];
  }

  static float preferred_speed(const Crowd& crowd, const Grid& grid, const AgentView& around,
                               const Walker& self) {
    if (parameter(crowd, density_aware, self) == 0) return self.preferred_speed;
    const float density =
        density_ahead(crowd, grid, around, self.preferred_direction, DensityKernel{});
    return std::min(self.preferred_speed,
                    speed_at_density(
                        density, {parameter(crowd, factor, self), parameter(crowd, buffer, self)}));
  }

  /// Recomputes the planes, from `first` on, of neighbors with another priority. An agent without
  /// right of way does more than half of what is needed, and assumes that the other keeps its
  /// preferred velocity, except for kTolerance.
  static void apply_right_of_way(const Crowd& crowd, const Grid& grid, const AgentView& around,
                                 const Disc& self, std::size_t first, HalfPlanes& planes) {
    const Agents& agents = crowd.agents;
    const std::vector<float>& priority = agents[Property::priority];
    for (std::size_t i = 0; i < around.neighbors.size(); ++i) {
      const std::size_t slot = around.neighbors[i].slot;
      const std::size_t id = grid.id(slot);
      const float advantage = std::clamp(priority[around.agent] - priority[id], -1.0F, 1.0F);
      if (advantage == 0) continue;
      Disc other{grid.position(slot), grid.velocity(slot), grid.radius(slot)};
      constexpr float kNudge = 1e-3F;  // m
      if (other.position == self.position) {
        other.position.x() += id > around.agent ? kNudge : -kNudge;
      }
      if (advantage < 0) {
        constexpr float kTolerance = 0.1F;  // m/s
        const Eigen::Vector2f preferred =
            agents.preferred_speed[id] * agents.preferred_direction[id];
        const Eigen::Vector2f deviation = other.velocity - preferred;
        const float length = deviation.norm();
        other.velocity = preferred + (length > kTolerance ? kTolerance / length : 1.0F) * deviation;
      }
      HalfPlane plane = avoid_disc(self, other, agents.model_parameters[tau][around.agent],
                                   static_cast<float>(crowd.dt_s));
      // The plane is for half of the change.
      plane.point = self.velocity + (1 - advantage) * (plane.point - self.velocity);
      planes.set(first + i, plane);
    }
  }

  AvoidDiscs* avoid_discs_;
  PerThread<Workspace> workspaces_;
};

std::unique_ptr<Model> make_pedvo(const Crowd& crowd) { return std::make_unique<PedVo>(crowd); }

}  // namespace

ModelEntry pedvo_model() {
  return {"pedvo",
          "PedVO",
          "ORCA with room for strides, right of way and a bias for turning (Curtis and Manocha "
          "2014)",
          {{"tau", 2.5F, 1e-3F, 1000, "how long moves stay free of others, in s"},
           {"tauObst", 0.15F, 1e-3F, 1000, "how long moves stay free of walls, in s"},
           {"turningBias", 1, 0.01F, 100, "above 1: rather turn than change speed"},
           {"factor", 1.57F, 0.01F, 100, "stature: the higher, the shorter the strides at a speed"},
           {"buffer", 0.9F, 0, 100, "room before and behind a stride, of its length"},
           {"density_aware", 1, 0, 1, "1: slower where it is crowded"}},
          {},
          make_pedvo};
}

}  // namespace throng::crowd
