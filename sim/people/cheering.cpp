#include "sim/people/cheering.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/compute/random.h"
#include "base/geometry/smoothstep.h"

namespace throng::sim {

namespace {

constexpr double kEveryS = 25;        // a moment that makes people get up
constexpr double kFirstS = 5;         // at the earliest
constexpr double kSpreadS = 1.5;      // over all blocks
constexpr double kGetUp = 0.7;        // share of people
constexpr double kCheer = 0.7;        // of those
constexpr double kStand = 0.08;       // share of people who stand anyway
constexpr double kChangeEveryS = 60;  // when single people may change
constexpr double kChange = 0.1;       // share of people who do
constexpr std::uint64_t kWaves = 1;   // indices of random numbers, apart from each other
constexpr std::uint64_t kHabit = 2;
constexpr std::uint64_t kChanges = 1U << 20U;
constexpr std::uint64_t kAnswers = 1U << 21U;
constexpr double kSlackS = 1e-6;

}  // namespace

/// A time for which somebody does something; empty if it does not begin.
struct CheeringWaves::Span {
  double begin_s = std::numeric_limits<double>::infinity();
  double end_s = std::numeric_limits<double>::infinity();
  bool cheers = false;

  bool has(double time_s) const { return time_s >= begin_s - kSlackS && time_s < end_s - kSlackS; }
  /// From 0 to 1 after its begin and back after its end.
  double ramp(double time_s) const {
    if (time_s < begin_s) return 0;
    const double rise = geometry::smoothstep((time_s - begin_s) / kRiseS);
    return std::min(rise, 1 - geometry::smoothstep((time_s - end_s) / kRiseS));
  }
};

CheeringWaves::CheeringWaves(std::uint64_t seed, double step_s) : seed_(seed), step_s_(step_s) {}

double CheeringWaves::on_step(double time_s) const {
  return step_s_ * std::round(time_s / step_s_);
}

// Only one wave can concern a time: the last one ends before the next can begin.
CheeringWaves::Span CheeringWaves::wave_for(double time_s, std::uint64_t key, double place) const {
  if (time_s < kFirstS) return {};
  const auto number = static_cast<std::uint64_t>((time_s - kFirstS) / kEveryS);
  Random wave(derive_seed(seed_, Stream::spectators, kWaves), Stream::spectators, number);
  const double wave_s = kFirstS + kEveryS * static_cast<double>(number) + wave.uniform(0, 10);
  const double lasts_s = wave.uniform(6, 10);
  const double origin = wave.uniform();
  Random answer(key, Stream::spectators, kAnswers + number);
  if (answer.uniform() >= kGetUp) return {};
  const bool cheers = answer.uniform() < kCheer;
  const double late_s = kSpreadS * (0.7 * std::abs(place - origin) + 0.3 * answer.uniform());
  const double begin_s = wave_s + late_s;
  return {on_step(begin_s), on_step(begin_s + lasts_s * answer.uniform(0.85, 1.0)), cheers};
}

CheeringWaves::Span CheeringWaves::change_for(double time_s, std::uint64_t key) const {
  const auto number = static_cast<std::uint64_t>(time_s / kChangeEveryS);
  Random change(key, Stream::spectators, kChanges + number);
  if (change.uniform() >= kChange) return {};
  const double begin_s = kChangeEveryS * static_cast<double>(number) + change.uniform(1, 40);
  return {on_step(begin_s), on_step(begin_s + change.uniform(5, 15)), false};
}

PostureNow CheeringWaves::posture_at(double time_s, std::uint64_t key, double place) const {
  const bool stands_anyway = Random(key, Stream::spectators, kHabit).uniform() < kStand;
  const Span change = change_for(time_s, key);
  const Span wave = wave_for(time_s, key, place);
  const double own = stands_anyway ? 1 - change.ramp(time_s) : change.ramp(time_s);
  PostureNow now;
  now.risen = std::max(own, wave.ramp(time_s));
  if (wave.has(time_s)) {
    now.posture = wave.cheers ? Posture::cheering : Posture::standing;
  } else if (stands_anyway != change.has(time_s)) {
    now.posture = Posture::standing;
  }
  return now;
}

}  // namespace throng::sim
