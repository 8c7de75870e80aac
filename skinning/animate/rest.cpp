#include "skinning/animate/rest.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/angle.h"
#include "skinning/animate/plan.h"

namespace throng::skinning {

namespace {

constexpr double kFallS = 1.3;
constexpr double kGetUpS = 2.2;
constexpr double kFastFallMps = 1.2;  // who is faster falls on the face
constexpr double kSlowTurnRadps = 12 * kDegree;
constexpr double kSmallTurnRad = 15 * kDegree;

double turned(const Moment& from, const Moment& to) {
  return geometry::turn_rad(from.yaw_rad, to.yaw_rad);
}

struct Turning {
  const Clip* clip = nullptr;
  int times = 1;
};

// Combination of turns that comes nearest to an angle.
Turning choose_turning(const ClipSet& clips, double angle_rad) {
  Turning best;
  double best_error = 1e9;
  for (const auto& [name, degrees] :
       {std::pair{"turn_90", 90.0}, {"turn_60", 60.0}, {"turn_30", 30.0}}) {
    const Clip* clip = clips.find(name);
    const int times = std::max(static_cast<int>(std::lround(angle_rad / (degrees * kDegree))), 1);
    const double error = std::abs(std::log(angle_rad / (times * degrees * kDegree)));
    if (clip == nullptr || error >= best_error) continue;
    best = {clip, times};
    best_error = error;
  }
  return best;
}

}  // namespace

RestLayer::RestLayer(const Trajectory& trajectory, const ClipSet& clips, double phase_offset,
                     Random random, std::vector<Piece>& pieces)
    : trajectory_(trajectory),
      clips_(clips),
      phase_offset_(phase_offset),
      random_(random),
      phones_(random_.uniform() < 0.4),
      pieces_(pieces) {}

void RestLayer::add(const Clip& clip, double begin, double end, double frame, double to_frame) {
  pieces_.push_back({begin, begin, end, frame, to_frame, &clip, false});
}

void RestLayer::stand(const Stretch& stretch, bool first, bool last) {
  auto begin = static_cast<double>(stretch.first);
  const Clip& stand = clips_.nearest("idle");
  if (first || begin == static_cast<double>(stretch.last)) {
    // In the middle of swaying.
    const double left = stand.frames * (1 - phase_offset_);
    double end = begin + steps(kIdlePeriod * (1 - phase_offset_));
    if (last && stretch.first == stretch.last) end = begin + 1;
    if (end <= static_cast<double>(stretch.last) || last) {
      add(stand, begin, end, stand.frames - left, stand.frames);
      begin = std::min(end, static_cast<double>(stretch.last));
    }
  }
  std::size_t at = static_cast<std::size_t>(std::ceil(begin));
  const std::span<const Moment> moments = trajectory_.moments();
  while (at < stretch.last) {
    std::size_t end = at;
    double angle = 0;
    while (end < stretch.last) {
      const double step = turned(moments[end], moments[end + 1]);
      if (std::abs(step) < kSlowTurnRadps * trajectory_.dt_s() || step * angle < 0) break;
      angle += step;
      ++end;
    }
    if (std::abs(angle) >= kSmallTurnRad) {
      idle(begin, static_cast<double>(at));
      turn(at, end);
      begin = static_cast<double>(end);
    }
    at = std::max(end, at + 1);
  }
  idle(begin, static_cast<double>(stretch.last));
}

// Feet step as fast as the body turns.
void RestLayer::turn(std::size_t begin, std::size_t end) {
  const std::span<const Moment> moments = trajectory_.moments();
  double whole = 0;
  for (std::size_t step = begin; step < end; ++step) {
    whole += turned(moments[step], moments[step + 1]);
  }
  const Turning turning = choose_turning(clips_, std::abs(whole));
  if (turning.clip == nullptr) {
    idle(static_cast<double>(begin), static_cast<double>(end));
    return;
  }
  // A turn to the right is one to the left backwards.
  const double frames = turning.times * static_cast<double>(turning.clip->frames);
  double done = 0;
  for (std::size_t step = begin; step < end; ++step) {
    const double before = done / whole;
    done += turned(moments[step], moments[step + 1]);
    const double after = done / whole;
    const auto frame = [&](double share) { return frames * (whole > 0 ? share : 1 - share); };
    add(*turning.clip, static_cast<double>(step), static_cast<double>(step + 1), frame(before),
        frame(after));
  }
}

double RestLayer::gaze_begins(double from, double to) const {
  for (auto step = static_cast<std::size_t>(from); static_cast<double>(step) < to; ++step) {
    if (trajectory_.moments()[step].gaze != Gaze::none)
      return std::max(static_cast<double>(step), from);
  }
  return to;
}

double RestLayer::gaze_ends(double from, double to) const {
  const auto first = static_cast<std::size_t>(from);
  const Gaze gaze = trajectory_.moments()[first].gaze;
  for (std::size_t step = first; static_cast<double>(step) < to; ++step) {
    if (trajectory_.moments()[step].gaze != gaze) return static_cast<double>(step);
  }
  return to;
}

// From and to the stance in which everything on the spot begins and ends.
void RestLayer::idle(double begin, double end) {
  while (end - begin > 1e-9) begin = idle_once(begin, end);
}

double RestLayer::idle_once(double begin, double end) {
  constexpr double kShortLookS = 2.4;
  const Gaze gaze = trajectory_.moments()[static_cast<std::size_t>(begin)].gaze;
  if (gaze != Gaze::none && end - begin >= steps(kShortLookS)) {
    const char* name = gaze == Gaze::left    ? "look_up_left"
                       : gaze == Gaze::right ? "look_up_right"
                                             : "look_up";
    const Clip* clip = clips_.find(name);
    if (clip != nullptr) {
      const double until = std::clamp(gaze_ends(begin, end), begin + steps(kShortLookS), end);
      hold(*clip, begin, until, 0.7);
      return until;
    }
  }
  // A person who is looking at nothing notices it when it comes.
  const double until = gaze == Gaze::none ? gaze_begins(begin, end) : end;
  const double left_s = (until - begin) * trajectory_.dt_s();
  const Clip& stand = clips_.nearest("idle");
  const Clip* around = clips_.find("look_around");
  const Clip* phone = clips_.find("phone");
  const double what = random_.uniform();
  const double length = random_.uniform();
  const double look_s = 5 + 2 * length;
  if (what < 0.22 && around != nullptr && left_s > look_s) {
    add(*around, begin, begin + steps(look_s), 0, around->frames);
    return begin + steps(look_s);
  }
  const double phone_s = 6 + 12 * length;
  if (phones_ && what > 0.6 && phone != nullptr && left_s > phone_s) {
    hold(*phone, begin, begin + steps(phone_s), 0.9);
    return begin + steps(phone_s);
  }
  const double sway_s = kIdlePeriod * (0.85 + 0.3 * length);
  if (left_s > 0.6 * kIdlePeriod) {
    const double last = left_s < 1.6 * sway_s ? until : begin + steps(sway_s);
    add(stand, begin, last, 0, stand.frames);
    return last;
  }
  // A moment only: a little sway and back.
  const double middle = 0.5 * (begin + until);
  const double sway = stand.frames * 0.5 * left_s / kIdlePeriod;
  add(stand, begin, middle, 0, sway);
  add(stand, middle, until, sway, 0);
  return until;
}

// Raised in the first half of the clip, held for as long as there is time, and lowered.
void RestLayer::hold(const Clip& clip, double begin, double end, double raising_s) {
  constexpr double kHeldS = 4;
  const double raised = (clip.frames - 1) / 2;  // NOLINT(bugprone-integer-division): a frame
  const double raising = std::min(steps(raising_s), 0.4 * (end - begin));
  const double held = end - begin - 2 * raising;
  const int times = std::max(static_cast<int>(std::lround(held / steps(kHeldS))), 1);
  add(clip, begin, begin + raising, 0, raised);
  for (int i = 0; i < times; ++i) {
    add(clip, begin + raising + held * i / times, begin + raising + held * (i + 1) / times, raised,
        2 * raised);
  }
  add(clip, end - raising, end, raised, 0);
}

void RestLayer::lie(const Stretch& stretch, bool first, bool last) {
  // A person who is up at the last step has got up before.
  const bool stays_down = last && trajectory_.moments()[stretch.last].down;
  const auto begin = static_cast<double>(stretch.first);
  const auto end = static_cast<double>(stretch.last);
  const double before = std::max(begin - steps(1.0), 0.0);
  const double speed = (trajectory_.distance_m(begin) - trajectory_.distance_m(before)) /
                       std::max((begin - before) * trajectory_.dt_s(), 1e-6);
  const bool forwards = random_.uniform() < (speed > kFastFallMps ? 0.9 : 0.5);
  const Clip* clip = clips_.find(forwards ? "fall_forwards" : "fall_backwards");
  if (clip == nullptr) {
    idle(begin, std::max(end, begin + 1));
    return;
  }
  const double lying = clip->frames - 1;
  double lies_from = begin;
  if (!first) {
    lies_from = begin + (stays_down ? steps(kFallS) : std::min(steps(kFallS), 0.5 * (end - begin)));
    // Slowly at first, as everything falls.
    const double halfway = std::lerp(begin, lies_from, 0.6);
    add(*clip, begin, halfway, 0, 0.45 * lying);
    add(*clip, halfway, lies_from, 0.45 * lying, lying);
  }
  const double lies_to = stays_down ? std::max(end, lies_from) + 1
                                    : end - std::min(steps(kGetUpS), 0.5 * (end - begin));
  add(*clip, lies_from, lies_to, lying, lying);
  if (stays_down) return;
  add(*clip, lies_to, end, lying, 0);
  if (last) idle(end, end + 1);
}

}  // namespace throng::skinning
