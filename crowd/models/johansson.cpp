#include <algorithm>
#include <cmath>

#include "crowd/models/local_model.h"

namespace throng::crowd {

namespace {

enum Parameter : std::size_t { fov_weight };
enum Constant : std::size_t {
  agent_scale,
  obstacle_scale,
  reaction_time,
  force_distance,
  stride_time
};

/// Social forces with elliptical equipotential lines, "elliptical specification II" of Johansson,
/// Helbing and Shukla (2007), with the other's own step instead of the relative one.
class Johansson : public LocalModel {
 public:
  explicit Johansson(const Crowd& crowd)
      : LocalModel(crowd),
        constants_(crowd.model_constants),
        behind_matters_(crowd.compat != Compat::none) {}

 protected:
  Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid, const AgentView& around) override {
    const Walker self(crowd, grid, around.slot);
    const float rear = crowd.agents.model_parameters[fov_weight][self.id];
    Eigen::Vector2f acceleration =
        (self.preferred_velocity() - self.velocity) / constants_[reaction_time];
    for (const Grid::Neighbor& neighbor : around.neighbors) {
      const BodyOffset apart(self, grid.id(neighbor.slot), grid.position(neighbor.slot));
      acceleration += push(apart, grid.velocity(neighbor.slot)) *
                      attention(self, apart.away, behind_matters_, rear);
    }
    for_each_wall(crowd, grid, around, [&](const Segment& wall) {
      const BodyOffset apart(self, wall);
      acceleration += constants_[obstacle_scale] * attention(self, apart.away, false, rear) *
                      std::exp(-apart.distance / constants_[force_distance]) * apart.away;
    });
    return self.velocity + static_cast<float>(crowd.dt_s) * acceleration;
  }

 private:
  /// How much something counts that pushes in the direction `away`: 1 for what is ahead, `rear`
  /// for what is behind. Menge has it the other way round for others (not for walls): its series
  /// are met to 0.1 mm over 8 s only so.
  static float attention(const Walker& self, const Eigen::Vector2f& away, bool behind_matters,
                         float rear) {
    const float cosine = away.dot(self.orientation);
    return rear + (1 - rear) * 0.5F * (1 + (behind_matters ? cosine : -cosine));
  }

  /// The ellipse's foci are where the other is and where it will be after a stride; b is the
  /// semi-minor axis of the one through here.
  Eigen::Vector2f push(const BodyOffset& apart, const Eigen::Vector2f& other_velocity) const {
    constexpr float kThinnest = 1e-3F;  // m; between the foci b is 0 and the force without limit
    const Eigen::Vector2f stride = constants_[stride_time] * other_velocity;
    const Eigen::Vector2f later = apart.offset - stride;
    const float later_distance = later.norm();
    const float sum = apart.distance + later_distance;
    const float b =
        std::max(0.5F * std::sqrt(std::max(0.0F, sum * sum - stride.squaredNorm())), kThinnest);
    return constants_[agent_scale] * sum / (2 * b) * std::exp(-b / constants_[force_distance]) *
           0.5F * (apart.away + unit_or(later, apart.away));
  }

  const std::vector<float>& constants_;
  bool behind_matters_;
};

std::unique_ptr<Model> make_johansson(const Crowd& crowd) {
  return std::make_unique<Johansson>(crowd);
}

}  // namespace

ModelEntry johansson_model() {
  return {"johannson",
          "Johansson",
          "social forces with elliptical equipotential lines (Johansson, Helbing and Shukla 2007); "
          "with Menge's quirks others behind count more than those ahead",
          {{"fov_weight", 0.16F, 0, 1, "how much what is behind counts, of what is ahead"}},
          {{"agent_scale", 0.11F, 0, 1e4F, "strength of the push by others, in m/s^2"},
           {"obstacle_scale", 0.11F, 0, 1e4F, "strength of the push by walls, in m/s^2"},
           {"reaction_time", 0.5F, 1e-3F, 1000, "in which the preferred velocity is taken, in s"},
           {"force_distance", 1.19F, 1e-3F, 1000, "over which pushes fall to 1/e, in m"},
           {"stride_time", 0.5F, 0, 100, "how far ahead others' steps are seen, in s"}},
          make_johansson,
          "johansson"};
}

}  // namespace throng::crowd
