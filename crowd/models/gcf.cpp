#include <algorithm>
#include <cmath>

#include "crowd/models/ellipse.h"
#include "crowd/models/local_model.h"

namespace throng::crowd {

namespace {

enum Parameter : std::size_t { stand_depth, move_scale, slow_width, sway_change };
enum Constant : std::size_t {
  reaction_time,
  agent_force_strength,
  max_agent_dist,
  max_agent_force,
  agent_interp_width,
  speed_color
};

constexpr float kMinDistance = 0.01F;  // m, in what is divided by a distance

/// The cubic over [x0, x1] with these values and slopes at the ends (Hermite).
float hermite(float x, float x0, float y0, float slope0, float x1, float y1, float slope1) {
  const float width = x1 - x0;
  const float t = (x - x0) / width;
  const float u = 1 - t;
  return u * u * ((1 + 2 * t) * y0 + t * width * slope0) +
         t * t * ((1 + 2 * u) * y1 - u * width * slope1);
}

/// Generalized centrifugal force model: repulsion between ellipses that grow with speed (Chraibi,
/// Seyfried and Schadschneider 2010). Parameters that the brief description of Menge's leaves open
/// are fitted to its series: cross is met to 0.1 mm, bottleneck to 1 mm in the first seconds if the
/// distance is the one of closest approach, what divides the closing speed is that distance too,
/// and the ends of the response are blended over 5/3 of the interpolation width.
class Gcf : public LocalModel {
 public:
  explicit Gcf(const Crowd& crowd)
      : LocalModel(crowd),
        constants_(crowd.model_constants),
        quirks_(crowd.compat != Compat::none) {
    constexpr float kWider = 5.0F / 3;
    blend_ = std::clamp(kWider * constants_[agent_interp_width], kMinDistance,
                        0.5F * constants_[max_agent_dist]);
  }

 protected:
  Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid, const AgentView& around) override {
    const Walker self(crowd, grid, around.slot);
    const Ellipse body = make_body(crowd, self.id, self.velocity);
    Eigen::Vector2f acceleration =
        (self.preferred_velocity() - self.velocity) / constants_[reaction_time];
    for (const Grid::Neighbor& neighbor : around.neighbors) {
      const std::size_t id = grid.id(neighbor.slot);
      const Eigen::Vector2f& velocity = grid.velocity(neighbor.slot);
      const BodyOffset apart(self, id, grid.position(neighbor.slot));
      acceleration +=
          push(self, body, apart, velocity, make_body(crowd, id, velocity)) * apart.away;
    }
    for_each_wall(crowd, grid, around, [&](const Segment& wall) {
      constexpr float kMinLength = 0.1F;  // m
      if ((wall.end - wall.begin).norm() < kMinLength) return;
      const BodyOffset apart(self, wall);
      acceleration += wall_push(self, body, apart) * apart.away;
    });
    return self.velocity + static_cast<float>(crowd.dt_s) * acceleration;
  }

 private:
  static Ellipse make_body(const Crowd& crowd, std::size_t id, const Eigen::Vector2f& velocity) {
    constexpr float kThinnest = 0.01F;  // m
    constexpr float kSwaySpeed = 1.3F;  // m/s
    const auto& parameters = crowd.agents.model_parameters;
    const float speed = velocity.norm();
    return {std::max(parameters[stand_depth][id] + parameters[move_scale][id] * speed, kThinnest),
            std::max(parameters[slow_width][id] - parameters[sway_change][id] * speed / kSwaySpeed,
                     kThinnest),
            crowd.agents.orientation[id]};
  }

  float push(const Walker& self, const Ellipse& body, const BodyOffset& apart,
             const Eigen::Vector2f& other_velocity, const Ellipse& other_body) const {
    // Bodies are no longer than this, so that far ones need no closer look.
    const float reach =
        std::max(body.along, body.across) + std::max(other_body.along, other_body.across);
    if (apart.distance - reach >= constants_[max_agent_dist]) return 0;
    const float gap = apart.distance - contact_distance(body, other_body, apart.away);
    if (gap >= constants_[max_agent_dist]) return 0;
    const float closing = std::max(0.0F, apart.away.dot(other_velocity - self.velocity));
    const float rush = constants_[agent_force_strength] * self.preferred_speed +
                       closing / std::max(gap, kMinDistance);
    // 1 for who is ahead, 0.1 for who is behind.
    const float attention = 0.55F - 0.45F * apart.away.dot(self.orientation);
    const float strength = attention * response(gap) * rush * rush;
    return quirks_ ? strength : std::min(strength, response(0));
  }

  /// 1 / gap, but finite when they touch and nothing from max_agent_dist on.
  float response(float gap) const {
    const float far = constants_[max_agent_dist] - blend_;
    if (gap <= 0) return 3 * constants_[max_agent_force];
    if (gap < blend_) {
      return hermite(gap, 0, 3 * constants_[max_agent_force], 0, blend_, 1 / blend_,
                     -1 / (blend_ * blend_));
    }
    if (gap <= far) return 1 / gap;
    return hermite(gap, far, 1 / far, -1 / (far * far), constants_[max_agent_dist], 0, 0);
  }

  /// Falls with the distance from the body to the wall. Menge's formula is described as attractive
  /// very near to the wall; its series are met (4square and pedModelSwap to 1 mm over 5 s,
  /// bottleneck to 1 cm over 18 s and in its duration to 4 %) if there is no push at all from
  /// walls that are nearer than a fifth of the body's extent.
  float wall_push(const Walker& self, const Ellipse& body, const BodyOffset& apart) const {
    const float extent = contact_distance(body, apart.away);
    const float gap = apart.distance - extent;
    if (quirks_) return gap < 0.2F * extent ? 0 : self.preferred_speed * extent / gap;
    return std::min(self.preferred_speed * extent / std::max(gap, kMinDistance), response(0));
  }

  const std::vector<float>& constants_;
  bool quirks_;
  float blend_;  // m
};

std::unique_ptr<Model> make_gcf(const Crowd& crowd) { return std::make_unique<Gcf>(crowd); }

}  // namespace

ModelEntry gcf_model() {
  return {
      "gcf",
      "GCF",
      "repulsion between ellipses that grow with speed (Chraibi et al. 2010); with Menge's quirks "
      "forces have no limit, and walls do not push who is very near",
      {{"stand_depth", 0.18F, 0.01F, 10, "half of the depth of a body at rest, in m", "facing_min"},
       {"move_scale", 0.53F, 0, 10, "by which that grows with speed, in s", "facing_rate"},
       {"slow_width", 0.25F, 0.01F, 10, "half of the width of a body at rest, in m", "perp_max"},
       {"sway_change", 0.05F, 0, 10, "by which that falls at 1.3 m/s, in m", "perp_growth"}},
      {{"reaction_time", 0.5F, 1e-3F, 1000, "in which the preferred velocity is taken, in s"},
       {"agent_force_strength", 0.3F, 0, 1000,
        "share of the preferred speed in the push by others"},
       {"max_agent_dist", 2, 0.1F, 1000, "from how far others push, in m"},
       {"max_agent_force", 3, 0, 1e4F, "a third of the push of who touches, in m/s^2"},
       {"agent_interp_width", 0.12F, 0, 1000, "over which the push is blended at its ends, in m"},
       {"speed_color", 0, 0, 1, "not used: it was for Menge's own display"}},
      make_gcf};
}

}  // namespace throng::crowd
