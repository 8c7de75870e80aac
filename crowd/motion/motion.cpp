// Several agents at a time: everything below is computed lane by lane, on both sides of what would
// be a branch, and once more alike for the last few agents, one at a time.
#include "crowd/motion/motion.h"

#include <array>
#include <cmath>

#include "base/compute/parallel.h"
#include "base/compute/simd.h"

namespace throng::crowd {

namespace {

constexpr std::size_t kGrain = 512;  // agents per task

template <typename Float>
struct Vector {
  Float x;
  Float y;
};

template <typename Float>
Vector<Float> operator+(const Vector<Float>& a, const Vector<Float>& b) {
  return {a.x + b.x, a.y + b.y};
}

template <typename Float>
Vector<Float> operator-(const Vector<Float>& a, const Vector<Float>& b) {
  return {a.x - b.x, a.y - b.y};
}

template <typename Float>
Vector<Float> operator*(const Float& factor, const Vector<Float>& v) {
  return {factor * v.x, factor * v.y};
}

template <typename Float>
Float dot(const Vector<Float>& a, const Vector<Float>& b) {
  return a.x * b.x + a.y * b.y;
}

template <typename Float, typename Mask>
Vector<Float> select(const Mask& mask, const Vector<Float>& a, const Vector<Float>& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y};
}

float root(float v) { return std::sqrt(v); }
Float4 root(Float4 v) { return square_root<4>(v); }
Float8 root(Float8 v) { return square_root<8>(v); }

/// v moved towards `wanted`, by at most `max_change`.
template <typename Float>
Vector<Float> approach(const Vector<Float>& v, const Vector<Float>& wanted,
                       const Float& max_change) {
  const Vector<Float> change = wanted - v;
  const Float size = root(dot(change, change));
  return select(size > max_change, v + (max_change / size) * change, wanted);
}

/// The direction that an agent turns to: its velocity, mixed with the preferred one when it is
/// slow.
template <typename Float>
Vector<Float> facing(const Vector<Float>& velocity, const Vector<Float>& preferred,
                     const Vector<Float>& orientation, const Float& pref_speed) {
  constexpr float kStanding = 1e-6F;  // m/s
  constexpr float kOpposed = 1e-3F;
  const Float speed = root(dot(velocity, velocity));
  const Vector<Float> moving = (1 / speed) * velocity;
  const Float share = root(3 * speed / pref_speed);
  const Vector<Float> mixed = share * moving + (1 - share) * preferred;
  const Float length = root(dot(mixed, mixed));
  const Vector<Float> slow = select(length > kOpposed, (1 / length) * mixed, orientation);
  return select(speed < kStanding, preferred, select(3 * speed >= pref_speed, moving, slow));
}

/// Whether somebody who looks somewhere (`watched`, 0: nowhere) shuffles at most.
template <typename Float>
auto keeps_facing(const Vector<Float>& velocity, const Vector<Float>& watched) {
  constexpr float kShuffle = 0.5F;  // m/s: one step a second, sideways or back
  // `watched` has the length 1 or 0: nobody is slower than 0.
  return dot(velocity, velocity) < kShuffle * kShuffle * dot(watched, watched);
}

/// `from` turned towards `to` by at most `most_rad`.
Vector<float> turn(const Vector<float>& from, const Vector<float>& to, float max_rad) {
  const float sine = from.x * to.y - from.y * to.x;
  const float angle = std::atan2(sine, dot(from, to));
  if (std::abs(angle) <= max_rad) return to;
  const float turned = std::copysign(max_rad, angle);
  const float c = std::cos(turned);
  const float s = std::sin(turned);
  const Vector<float> made{c * from.x - s * from.y, s * from.x + c * from.y};
  return (1 / std::sqrt(dot(made, made))) * made;
}

/// Whether `to` is sure to be within the angle of `from`.
template <typename Float>
auto nearly_there(const Vector<Float>& from, const Vector<Float>& to, const Float& max_rad) {
  const Float sine = from.x * to.y - from.y * to.x;
  // sin(a) >= a - a^3/6; beyond the square root of 2 that gets no better.
  const Float a = max_rad < 1.4F ? max_rad : Float{} + 1.4F;
  const Float min_sine = a - a * a * a / 6;
  return (dot(from, to) > 0) & ((sine < 0 ? -sine : sine) < min_sine);
}

/// atan2 by a polynomial through atan(a) / a at Chebyshev points in a^2; within 4e-7 rad.
template <typename Float>
Float angle_rad(const Vector<Float>& v) {
  const Float zero{};
  const Float wide = v.x < 0 ? -v.x : v.x;
  const Float high = v.y < 0 ? -v.y : v.y;
  const auto steep = high > wide;
  const Float longer = steep ? high : wide;
  const Float a = (steep ? wide : high) / (longer > 0 ? longer : zero + 1);
  const Float z = a * a;
  Float p = zero - 0.00455979211255908F;
  p = p * z + 0.023780519142746925F;
  p = p * z - 0.05882975459098816F;
  p = p * z + 0.09868865460157394F;
  p = p * z - 0.14003290235996246F;
  p = p * z + 0.19966961443424225F;
  p = p * z - 0.3333181142807007F;
  p = p * z + 0.9999998807907104F;
  constexpr float kPi = 3.14159265F;
  const Float first = p * a;
  const Float quarter = steep ? kPi / 2 - first : first;
  const Float half = v.x < 0 ? kPi - quarter : quarter;
  return v.y < 0 ? -half : half;
}

/// State of one agent or of several before a step.
template <typename Float>
struct Mover {
  Vector<Float> position;
  Vector<Float> velocity;
  Vector<Float> orientation;
  Vector<Float> wanted;  ///< velocity
  Vector<Float> preferred;
  Vector<Float> watched;  ///< where those look who stand
  Float pref_speed;
  Float accel_limit;  ///< m/s^2
  Float max_turn_rad;
};

void read(const float* from, float& to) { to = *from; }
void read(const float* from, Float4& to) { to = load<4>(from); }
void read(const float* from, Float8& to) { to = load<8>(from); }

void read(const Eigen::Vector2f* from, Vector<float>& to) { to = {from->x(), from->y()}; }
void read(const Eigen::Vector2f* from, Vector<Float4>& to) {
  deinterleave(load<4>(from[0].data()), load<4>(from[2].data()), to.x, to.y);
}
void read(const Eigen::Vector2f* from, Vector<Float8>& to) {
  deinterleave(load<8>(from[0].data()), load<8>(from[4].data()), to.x, to.y);
}

void write(const Vector<float>& v, Eigen::Vector2f* to) { *to = {v.x, v.y}; }
void write(const Vector<Float4>& v, Eigen::Vector2f* to) {
  Float4 first;
  Float4 second;
  interleave(v.x, v.y, first, second);
  store(first, to[0].data());
  store(second, to[2].data());
}
void write(const Vector<Float8>& v, Eigen::Vector2f* to) {
  Float8 first;
  Float8 second;
  interleave(v.x, v.y, first, second);
  store(first, to[0].data());
  store(second, to[4].data());
}

void write(float value, float* to) { *to = value; }
void write(Float4 value, float* to) { store(value, to); }
void write(Float8 value, float* to) { store(value, to); }

unsigned which(bool mask) { return mask ? 1 : 0; }
unsigned which(Int4 mask) { return movemask(mask); }
unsigned which(Int8 mask) { return movemask(mask); }

/// `from` (unit) turned left by an angle of at most pi.
template <typename Float>
Vector<Float> turned_left(const Vector<Float>& from, const Float& angle) {
  const Float z = angle * angle;
  // Taylor's polynomials, within 5e-4; the result is normalized.
  const Float sine =
      angle * (1 + z * (z * (1.0F / 120 + z * (z * (1.0F / 362880) - 1.0F / 5040)) - 1.0F / 6));
  const Float cosine = 1 + z * (z * (1.0F / 24 + z * (z * (1.0F / 40320) - 1.0F / 720)) - 0.5F);
  const Vector<Float> made{cosine * from.x - sine * from.y, sine * from.x + cosine * from.y};
  return (1 / root(dot(made, made))) * made;
}

/// The orientation after a step: people turn to where they want to look with a lag, and slowly
/// when they stand, since feet turn while they step.
template <typename Float>
Vector<Float> calmly_turned(const Vector<Float>& from, const Vector<Float>& to,
                            const Vector<Float>& velocity, const Float& max_turn_rad, float dt_s) {
  constexpr float kStandingLagS = 0.6F;
  constexpr float kWalkingLagS = 0.15F;
  constexpr float kStandingTurn = 0.25F;  // rad/s
  constexpr float kWalkingTurn = 9;       // rad/s
  constexpr float kWalkingMps = 1.2F;     // at which people turn as fast as they can
  const Float wanted = angle_rad<Float>({dot(from, to), from.x * to.y - from.y * to.x});
  const Float square = dot(velocity, velocity) / (kWalkingMps * kWalkingMps);
  const Float walks = square < 1 ? square : Float{} + 1;
  const Float part = dt_s * (1 / kStandingLagS + (1 / kWalkingLagS - 1 / kStandingLagS) * walks);
  const Float angle = wanted * (part < 1 ? part : Float{} + 1);
  const Float able = dt_s * (kStandingTurn + (kWalkingTurn - kStandingTurn) * walks);
  const Float limit = able < max_turn_rad ? able : max_turn_rad;
  return turned_left(from, angle > limit ? limit : (angle < -limit ? -limit : angle));
}

/// Settings of a step.
struct Step {
  float dt_s = 0;
  bool calm = true;  ///< false: people turn at once, as Menge's do
};

/// Moves as many agents as a Float has lanes.
template <typename Float>
void move_lanes(Agents& agents, std::span<const Eigen::Vector2f> new_velocity, const Step& step,
                std::size_t i) {
  Mover<Float> mover;
  read(&agents.position[i], mover.position);
  read(&agents.velocity[i], mover.velocity);
  read(&agents.orientation[i], mover.orientation);
  read(&new_velocity[i], mover.wanted);
  read(&agents.preferred_direction[i], mover.preferred);
  read(&agents.facing[i], mover.watched);
  read(&agents[Property::pref_speed][i], mover.pref_speed);
  read(&agents[Property::max_accel][i], mover.accel_limit);
  read(&agents[Property::max_angle_vel][i], mover.max_turn_rad);
  mover.max_turn_rad *= step.dt_s;

  const Float step_s = step.dt_s - Float{};
  const Vector<Float> velocity = approach(mover.velocity, mover.wanted, step_s * mover.accel_limit);
  Vector<Float> ahead = facing(velocity, mover.preferred, mover.orientation, mover.pref_speed);
  ahead = select(keeps_facing(velocity, mover.watched), mover.watched, ahead);
  write(velocity, &agents.velocity[i]);
  write(mover.position + step_s * velocity, &agents.position[i]);
  if (step.calm) {
    ahead = calmly_turned(mover.orientation, ahead, velocity, mover.max_turn_rad, step.dt_s);
    write(ahead, &agents.orientation[i]);
    write(angle_rad(ahead), &agents.yaw_rad[i]);
    return;
  }

  constexpr std::size_t kLanes =
      sizeof(Float) / sizeof(float);  // NOLINT(bugprone-sizeof-expression)
  constexpr unsigned kAll = (1U << kLanes) - 1;
  const unsigned there = which(nearly_there(mover.orientation, ahead, mover.max_turn_rad));
  if (there == kAll) {
    write(ahead, &agents.orientation[i]);
    write(angle_rad(ahead), &agents.yaw_rad[i]);
    return;
  }
  std::array<Eigen::Vector2f, 8> goals;
  write(ahead, goals.data());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    Eigen::Vector2f& now = agents.orientation[i + lane];
    Vector<float> turned{goals[lane].x(), goals[lane].y()};
    if ((there & (1U << lane)) == 0) {
      turned =
          turn({now.x(), now.y()}, turned, agents[Property::max_angle_vel][i + lane] * step.dt_s);
    }
    now = {turned.x, turned.y};
    agents.yaw_rad[i + lane] = angle_rad(turned);
  }
}

struct MoveKernel {
  template <int kWidth>
  static void run(Agents& agents, std::span<const Eigen::Vector2f> new_velocity, const Step& step,
                  std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end;) {
      if (i + kWidth <= end && all_present(agents, i, kWidth)) {
        move_lanes<typename Vectors<kWidth>::Float>(agents, new_velocity, step, i);
        i += kWidth;
      } else {
        if (agents.present[i] != 0) move_lanes<float>(agents, new_velocity, step, i);
        ++i;
      }
    }
  }

  static bool all_present(const Agents& agents, std::size_t begin, std::size_t count) {
    unsigned present = 1;
    for (std::size_t i = begin; i < begin + count; ++i) present &= agents.present[i];
    return present != 0;
  }
};

}  // namespace

void move(Crowd& crowd, std::span<const Eigen::Vector2f> new_velocity) {
  const auto move_some =
      Versions<MoveKernel, void(Agents&, std::span<const Eigen::Vector2f>, const Step&, std::size_t,
                                std::size_t)>::pick(crowd.instruction_set);
  const Step step{static_cast<float>(crowd.dt_s), crowd.compat == Compat::none};
  parallel_ranges(crowd.agents.count(), kGrain, [&](std::size_t begin, std::size_t end) {
    move_some(crowd.agents, new_velocity, step, begin, end);
  });
}

}  // namespace throng::crowd
