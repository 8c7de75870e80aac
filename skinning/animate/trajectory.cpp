#include "skinning/animate/trajectory.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace throng::skinning {

namespace {

// Nobody moves faster; a longer displacement within a step is a jump.
constexpr double kMaxSpeedMps = 12;
// A person who moves less than this within this time is standing.
constexpr double kShuffleM = 0.02;
constexpr double kPauseS = 0.9;
// Shorter displacements are not walks.
constexpr double kMinLengthM = 0.12;

}  // namespace

double at_step(std::span<const float> values, double step) {
  const double at = std::clamp(step, 0.0, static_cast<double>(values.size() - 1));
  const auto before = static_cast<std::size_t>(at);
  const std::size_t after = std::min(before + 1, values.size() - 1);
  return values[before] +
         (at - static_cast<double>(before)) * (static_cast<double>(values[after]) - values[before]);
}

Trajectory::Trajectory(std::span<const Moment> moments, double dt_s)
    : moments_(moments), dt_s_(dt_s) {
  check(!moments.empty() && dt_s > 0, "a trajectory has steps");
  distance_m_.reserve(moments.size());
  double distance = 0;
  distance_m_.push_back(0);
  for (std::size_t step = 1; step < moments.size(); ++step) {
    const double moved = (moments[step].position - moments[step - 1].position).norm();
    if (moved < kMaxSpeedMps * dt_s) distance += moved;
    distance_m_.push_back(static_cast<float>(distance));
  }
  find_stretches();
}

double Trajectory::distance_m(double step) const { return at_step(distance_m_, step); }

double Trajectory::step_at(double distance_m, std::size_t first, std::size_t last) const {
  const auto begin = distance_m_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = distance_m_.begin() + static_cast<std::ptrdiff_t>(last) + 1;
  const auto after = std::lower_bound(begin, end, static_cast<float>(distance_m));
  if (after == begin) return static_cast<double>(first);
  if (after == end) return static_cast<double>(last);
  const double low = *(after - 1);
  const auto before = static_cast<double>(after - distance_m_.begin() - 1);
  return before + std::clamp((distance_m - low) / (*after - low), 0.0, 1.0);
}

double Trajectory::speed_mps(double from_m, double to_m, std::size_t first,
                             std::size_t last) const {
  const double low = std::max<double>(from_m, distance_m_[first]);
  const double high = std::min<double>(to_m, distance_m_[last]);
  const double steps = step_at(high, first, last) - step_at(low, first, last);
  return steps > 0 ? (high - low) / (steps * dt_s_) : 0;
}

// Looks around a step, not at its speed alone: crowds jostle people who stand.
bool Trajectory::stands_at(std::size_t step) const {
  const auto reach = static_cast<std::size_t>(std::ceil(0.5 * kPauseS / dt_s_));
  const std::size_t before = step - std::min(step, reach);
  const std::size_t after = std::min(step + 1 + reach, last());
  return (moments_[after].position - moments_[before].position).norm() < kShuffleM;
}

void Trajectory::find_stretches() {
  const auto add = [&](Activity activity, std::size_t first, std::size_t last_step) {
    if (!stretches_.empty() && stretches_.back().activity == activity) {
      stretches_.back().last = last_step;
    } else {
      stretches_.push_back({activity, first, last_step});
    }
  };
  const auto drop_short_walk = [&] {
    if (stretches_.empty() || stretches_.back().activity != Activity::moving) return;
    const Stretch walk = stretches_.back();
    const bool cut_off = walk.first == 0 || walk.last == last();
    if (cut_off || distance_m_[walk.last] - distance_m_[walk.first] >= kMinLengthM) return;
    stretches_.pop_back();
    add(Activity::standing, walk.first, walk.last);
  };
  std::size_t step = 0;
  while (step < last()) {
    if (moments_[step].down) {
      drop_short_walk();
      add(Activity::lying, step, step + 1);
      ++step;
      continue;
    }
    const bool stands = stands_at(step);
    if (stands) drop_short_walk();
    add(stands ? Activity::standing : Activity::moving, step, step + 1);
    ++step;
  }
  drop_short_walk();
  const bool falls_last = moments_[last()].down &&
                          (stretches_.empty() || stretches_.back().activity != Activity::lying);
  if (falls_last) {
    stretches_.push_back({Activity::lying, last(), last()});
  } else if (stretches_.empty()) {
    stretches_.push_back({Activity::standing, 0, 0});
  }
}

}  // namespace throng::skinning
