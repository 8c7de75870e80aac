// How agents of the time-to-collision law move within a step: forces between discs, and their
// integration. For kernels only (base/compute/simd.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/compute/simd.h"
#include "crowd/models/ttc_lanes.h"

namespace throng::crowd {

/// The motion of kWidth agents, one per lane.
template <int kWidth>
struct TtcMotion {
  using Float = typename Vectors<kWidth>::Float;
  using Int = typename Vectors<kWidth>::Int;

  /// Forces between discs are integrated with this step, whatever the simulation's step is.
  static constexpr float kStepS = 0.02F;
  /// Collisions farther ahead in time are not seen; nearer ones count as if they were this near.
  static constexpr float kMaxHorizonS = 8;
  static constexpr float kMinTimeS = 0.02F;
  /// Weaker forces on somebody who touches nobody change little within a step: one evaluation is
  /// enough.
  static constexpr float kCalmForce = 0.05F;  // m/s^2
  /// Relative velocities below never collide, m^2/s^2.
  static constexpr float kMinRelativeSpeedSq = 1e-4F;
  static constexpr float kBehind = 0.3F;       // weight of others who are not in view
  static constexpr float kView = -0.2F;        // cosine of the edge of the view
  static constexpr float kMaxForce = 15;       // m/s^2
  static constexpr float kContact = 100;       // 1/s^2: force per depth of an overlap
  static constexpr float kWall = 10;           // m/s^2 at a wall
  static constexpr float kWallRangeM = 0.03F;  // over which that falls to 1/e
  static constexpr float kAtWallM = 0.15F;     // wall forces farther away hardly change in a step
  /// Forces make nobody faster than this or than they want to be.
  static constexpr float kShuffleMps = 0.1F;

  /// Agents that move, one per lane. All members have four bytes per lane (see copy_lane()).
  struct Movers {
    Float before_vx;  // at the beginning of the step, m/s
    Float before_vy;
    Float radius;
    Float direction_x;
    Float direction_y;
    Float wish_x;  // velocity without forces
    Float wish_y;
    Float speed;      // of that velocity
    Float max_back;   // speed at which they step back at most
    Float clearance;  // kept to oncoming people, m
    Float care;       // share of the avoidance
    Float vx;         // now
    Float vy;
    Float moved_x;  // since the beginning of the step, m
    Float moved_y;
    Int others;  // number of rows of others
    Int walls;   // number of rows of walls
  };

  /// The rows of the agents, from a lane on.
  struct Near {
    const TtcBatch::Row* rows;
    const TtcBatch::WallRow* walls;
    std::size_t first;
  };

  static void copy_lane(const Movers& from, std::size_t from_lane, Movers& to,
                        std::size_t to_lane) {
    static_assert(std::is_trivially_copyable_v<Movers>);
    constexpr std::size_t kBytes = sizeof(float);
    for (std::size_t at = 0; at < sizeof(Movers); at += kWidth * kBytes) {
      std::memcpy(reinterpret_cast<char*>(&to) + at + kBytes * to_lane,
                  reinterpret_cast<const char*>(&from) + at + kBytes * from_lane, kBytes);
    }
  }

  /// How a step is divided.
  struct Steps {
    /// The share that is left, after some of them, of the difference from a velocity that is aimed
    /// at, and its sum over them.
    struct Relaxation {
      float left = 1;
      float sum = 0;
    };

    Steps(float dt_s, float relaxation_s)
        : count(std::max(1, static_cast<int>(std::lround(dt_s / kStepS)))),
          step_s(dt_s / static_cast<float>(count)) {
      for (int step = 0; step < count; ++step) {
        all.left *= 1 - step_s / relaxation_s;
        all.sum += all.left;
        if (step == 0) one = all;
      }
    }

    int count;
    float step_s;
    Relaxation one;
    Relaxation all;
  };

  /// The first of the small steps; those on whom forces hardly change take all of them at once.
  /// Returns the others.
  static Int begin(const TtcConstants& c, const Steps& steps, const Near& near, Movers& movers) {
    const Pull pull = forces(c, near, movers, 0);
    const Int busy = pull.touches | (pull.size() > kCalmForce);
    const Float limit = max_speed(movers);
    const Float x = aim_x(c, movers, pull);
    const Float y = aim_y(c, movers, pull);
    Float calm_x = x;
    Float calm_y = y;
    restrain(movers, limit, calm_x, calm_y);
    const float dt_s = steps.step_s * static_cast<float>(steps.count);
    movers.moved_x = dt_s * calm_x + steps.step_s * steps.all.sum * (movers.vx - calm_x);
    movers.moved_y = dt_s * calm_y + steps.step_s * steps.all.sum * (movers.vy - calm_y);
    Float vx = x + steps.one.left * (movers.vx - x);
    Float vy = y + steps.one.left * (movers.vy - y);
    restrain(movers, limit, vx, vy);
    movers.moved_x = busy ? steps.step_s * vx : movers.moved_x;
    movers.moved_y = busy ? steps.step_s * vy : movers.moved_y;
    movers.vx = vx;
    movers.vy = vy;
    return busy;
  }

  /// The other small steps.
  static void finish(const TtcConstants& c, const Steps& steps, const Near& near, Movers& movers) {
    for (int step = 1; step < steps.count; ++step) {
      const Pull pull = forces(c, near, movers, steps.step_s * static_cast<float>(step));
      const Float limit = max_speed(movers);
      const Float x = aim_x(c, movers, pull);
      const Float y = aim_y(c, movers, pull);
      movers.vx = x + steps.one.left * (movers.vx - x);
      movers.vy = y + steps.one.left * (movers.vy - y);
      restrain(movers, limit, movers.vx, movers.vy);
      movers.moved_x += steps.step_s * movers.vx;
      movers.moved_y += steps.step_s * movers.vy;
    }
  }

 private:
  /// The force on an agent.
  struct Pull {
    Float x{};  // m/s^2
    Float y{};
    Int touches{};  // whether it touches somebody or is at a wall

    Float size() const { return square_root<kWidth>(x * x + y * y); }
    Float share() const {
      const Float all = size();
      return all > kMaxForce ? kMaxForce / all : Float{} + 1;
    }
  };

  /// The velocity that is aimed at.
  static Float aim_x(const TtcConstants& c, const Movers& movers, const Pull& pull) {
    return movers.wish_x + c.relaxation_s * pull.share() * pull.x;
  }
  static Float aim_y(const TtcConstants& c, const Movers& movers, const Pull& pull) {
    return movers.wish_y + c.relaxation_s * pull.share() * pull.y;
  }

  /// Forces make nobody faster than they are or want to be, or than people shuffle.
  static Float max_speed(const Movers& movers) {
    const Float now = square_root<kWidth>(movers.vx * movers.vx + movers.vy * movers.vy);
    return greater(greater(movers.speed, Float{} + kShuffleMps), now);
  }

  /// Limits a velocity to a speed, and to one at which people step back.
  static void restrain(const Movers& movers, Float limit, Float& vx, Float& vy) {
    const Float now = square_root<kWidth>(vx * vx + vy * vy);
    const Float slower = now > limit ? limit / now : Float{} + 1;
    vx *= slower;
    vy *= slower;
    const Float backward = -(vx * movers.direction_x + vy * movers.direction_y);
    const Float excess = greater(backward - movers.max_back, Float{});
    vx += excess * movers.direction_x;
    vy += excess * movers.direction_y;
  }

  /// The forces after some time in which the others go on as they do, but answer what this agent
  /// does.
  static Pull forces(const TtcConstants& c, const Near& near, const Movers& self, float time_s) {
    Pull pull;
    const float per_horizon = 1 / c.horizon_s;
    // Both give way by as much: without that they would do twice what is needed, and swing.
    const Float own_x = self.moved_x - time_s * self.before_vx;
    const Float own_y = self.moved_y - time_s * self.before_vy;
    const Float change_x = self.vx - self.before_vx;
    const Float change_y = self.vy - self.before_vy;
    for (std::int32_t i = 0; any(self.others > i); ++i) {
      const auto there = self.others > i;
      const TtcBatch::Row& row = near.rows[i];
      const Float other_vx = load<kWidth>(&row.vx[near.first]);
      const Float other_vy = load<kWidth>(&row.vy[near.first]);
      const Float touch = load<kWidth>(&row.touch[near.first]);
      const Float apart_x = self.moved_x - load<kWidth>(&row.x[near.first]) - time_s * other_vx;
      const Float apart_y = self.moved_y - load<kWidth>(&row.y[near.first]) - time_s * other_vy;
      const Float apart_sq = greater(apart_x * apart_x + apart_y * apart_y, Float{} + 1e-8F);
      const Float answer = 1 + (own_x * apart_x + own_y * apart_y) / apart_sq;
      const Float x = answer * apart_x;
      const Float y = answer * apart_y;
      const Float distance_sq = greater(x * x + y * y, Float{} + 1e-8F);
      const Float distance = square_root<kWidth>(distance_sq);
      const Float per_distance = 1 / distance;
      const Float away_x = x * per_distance;
      const Float away_y = y * per_distance;
      const Float together = away_x * change_x + away_y * change_y;
      const Float rx = self.vx - other_vx + together * away_x;
      const Float ry = self.vy - other_vy + together * away_y;
      const Float overlap = greater(touch - distance, Float{});
      Float push = kContact * overlap;
      // Discs that touch already avoid coming nearer.
      constexpr float kNotYet = 0.98F;
      const Float keeps_m = touch + self.clearance * load<kWidth>(&row.against[near.first]);
      const Float radius = smaller(keeps_m, kNotYet * distance);
      const Float a = rx * rx + ry * ry;
      const Float b = -(x * rx + y * ry);
      const Float discriminant = b * b - a * (distance_sq - radius * radius);
      const auto meets = there & (a > kMinRelativeSpeedSq) & (b > 0) & (discriminant > 0);
      push = there ? push : Float{};
      pull.touches |= push > 0;
      pull.x += push * away_x;
      pull.y += push * away_y;
      const Float root = square_root<kWidth>(greater(discriminant, Float{}));
      const Float some = meets ? a : Float{} + 1;
      const Float per_some = 1 / some;
      const Float time = greater((b - root) * per_some, Float{} + kMinTimeS);
      const auto soon = meets & (time < kMaxHorizonS);
      const Float per_time = 1 / time;
      const Float slope = c.strength_m2 * exponential(-per_horizon * time) * per_time * per_time *
                          (2 * per_time + per_horizon);
      // Discs that would just graze each other have a gradient without limit.
      constexpr float kGrazing = 0.1F;
      const Float per_smooth = 1 / greater(root, kGrazing * square_root<kWidth>(some));
      const auto unseen = self.direction_x * away_x + self.direction_y * away_y > -kView;
      const Float weight = self.care * load<kWidth>(&row.weight[near.first]) *
                           (unseen ? Float{} + kBehind : Float{} + 1);
      const Float scale = soon ? weight * slope * per_some : Float{};
      pull.x += scale * ((b * rx + a * x) * per_smooth - rx);
      pull.y += scale * ((b * ry + a * y) * per_smooth - ry);
    }
    for (std::int32_t i = 0; any(self.walls > i); ++i) {
      const auto there = self.walls > i;
      const Float x = self.moved_x - load<kWidth>(&near.walls[i].x[near.first]);
      const Float y = self.moved_y - load<kWidth>(&near.walls[i].y[near.first]);
      const Float distance = greater(square_root<kWidth>(x * x + y * y), Float{} + 1e-4F);
      const Float push = kWall * exponential((self.radius - distance) / kWallRangeM) / distance;
      pull.x += there ? push * x : Float{};
      pull.y += there ? push * y : Float{};
      pull.touches |= there & (distance < self.radius + kAtWallM);
    }
    return pull;
  }
};

}  // namespace throng::crowd
