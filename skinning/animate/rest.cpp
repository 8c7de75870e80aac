#include "skinning/animate/rest.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/angle.h"
#include "skinning/animate/piece.h"

namespace throng::skinning {

namespace {

constexpr double kFallS = 1.3;
constexpr double kAtEaseS = 20;  // the longest time from one stance of readiness to the next
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

RestLayer::RestLayer(const Trajectory& trajectory, const ClipSet& clips, const Rester& person,
                     Random random, std::vector<Piece>& pieces)
    : trajectory_(trajectory),
      clips_(clips),
      person_(person),
      random_(random),
      phones_(random_.uniform() < 0.4),
      calm_(random_.uniform(0.7, 1.4)),
      pieces_(pieces) {}

void RestLayer::add(const Clip& clip, double begin, double end, double frame, double to_frame) {
  pieces_.push_back({begin, begin, end, frame, to_frame, &clip, false});
}

void RestLayer::stand(const Stretch& stretch, bool first, bool last) {
  // Before the first step and after the last one people stand as well, in the middle of something.
  auto begin =
      static_cast<double>(stretch.first) - (first ? steps(kAtEaseS * person_.phase_offset) : 0);
  std::size_t at = stretch.first;
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
  idle(begin, static_cast<double>(stretch.last) + (last ? steps(kAtEaseS) : 0));
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

std::size_t RestLayer::moment_at(double step) const {
  return static_cast<std::size_t>(std::clamp(step, 0.0, static_cast<double>(trajectory_.last())));
}

double RestLayer::gaze_begins(double from, double to) const {
  for (std::size_t step = moment_at(from); step <= moment_at(to); ++step) {
    if (trajectory_.moments()[step].gaze != Gaze::none) {
      return std::clamp(static_cast<double>(step), from, to);
    }
  }
  return to;
}

double RestLayer::gaze_ends(double from, double to) const {
  const Gaze gaze = trajectory_.moments()[moment_at(from)].gaze;
  for (std::size_t step = moment_at(from); static_cast<double>(step) < to; ++step) {
    if (step > trajectory_.last()) break;
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
  const Gaze gaze = trajectory_.moments()[moment_at(begin)].gaze;
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
  const Clip* phone = clips_.find("phone");
  const double what = random_.uniform();
  const double phone_s = random_.uniform(6, 18);
  if (phones_ && what > 0.7 && phone != nullptr && left_s > phone_s) {
    hold(*phone, begin, begin + steps(phone_s), 0.9);
    return begin + steps(phone_s);
  }
  const Setting setting = trajectory_.moments()[moment_at(begin)].setting;
  const double act_s = random_.uniform(5, 16);
  const Act* act = left_s > act_s ? choose_act(setting) : nullptr;
  if (act != nullptr) {
    do_act(*act, *clips_.find(act->clip), begin, begin + steps(act_s));
    return begin + steps(act_s);
  }
  const double ease_s = random_.uniform(0.4, 0.9) * kAtEaseS;
  const double end_of_ease = left_s < 1.4 * ease_s ? until : begin + steps(ease_s);
  stand_at_ease(begin, end_of_ease);
  return end_of_ease;
}

// With the weight on one leg, mostly.
void RestLayer::stand_at_ease(double begin, double end) {
  constexpr double kShiftS = 1.3;
  const double draw = random_.uniform();
  const Clip& even = clips_.nearest("idle");
  const Clip* side = clips_.find(draw < 0.45 ? "idle_left" : "idle_right");
  if (draw > 0.9 || side == nullptr || end - begin < steps(4 * kShiftS)) {
    look_about_ready(even, begin, end);
    return;
  }
  shift_weight(even, *side, begin, begin + steps(kShiftS));
  look_about_ready(*side, begin + steps(kShiftS), end - steps(kShiftS));
  shift_weight(*side, even, end - steps(kShiftS), end);
}

void RestLayer::shift_weight(const Clip& from, const Clip& to, double begin, double end) {
  pieces_.push_back({begin, begin, end, static_cast<double>(from.first + ready_frame(from)),
                     static_cast<double>(to.first + ready_frame(to)), nullptr, false, 1});
}

void RestLayer::look_about_ready(const Clip& clip, double begin, double end) {
  look_about(clip, ready_frame(clip), ready_frame(clip), begin, end);
}

// Ahead, and now and then to a side.
void RestLayer::look_about(const Clip& clip, double middle, double reach, double begin,
                           double end) {
  double frame = middle;
  while (end - begin > 1e-9) {
    const double dwell_s = calm_ * random_.uniform(1.8, 5.5);
    const double share = random_.uniform() < 0.4 ? 0.9 : 0.35;
    const double drawn = middle + reach * random_.uniform(-share, share);
    const bool ends = end - begin < steps(1.6 * dwell_s);
    const double until = ends ? end : begin + steps(dwell_s);
    const double to = ends ? middle : drawn;
    const double s = (until - begin) * trajectory_.dt_s();
    const double turn_s = 0.5 + 0.8 * std::abs(to - frame) / std::max(reach, 1.0);
    add(clip, begin, until, frame, to);
    pieces_.back().moving = static_cast<float>(std::min(turn_s / s, 1.0));
    pieces_.back().sway = static_cast<float>(reach * std::min(0.08 * s, 0.25));
    frame = to;
    begin = until;
  }
}

const Act* RestLayer::choose_act(Setting setting) {
  // Shares of the time between looks at phones, by setting.
  constexpr std::array<double, 4> kActs = {0.4, 0.62, 0.66, 0.75};
  const auto where = static_cast<std::size_t>(setting);
  const bool acts_now = random_.uniform() < kActs.at(where);
  const double draw = random_.uniform();
  if (!acts_now) return nullptr;
  const auto likely = [&](const Act& act) {
    const bool suits = (act.hands < 2 || person_.has_free_hands) &&
                       person_.age_years >= act.youngest && person_.age_years < act.oldest &&
                       clips_.find(act.clip) != nullptr;
    return suits ? act.likely.at(where) : 0;
  };
  double all = 0;
  for (const Act& act : acts()) all += likely(act);
  double left = draw * all;
  for (const Act& act : acts()) {
    left -= likely(act);
    if (left < 0) return &act;
  }
  return nullptr;
}

// Raised, done for as long as there is time, and lowered.
void RestLayer::do_act(const Act& act, const Clip& clip, double begin, double end) {
  const double raising = steps(act.actions.has(Action::stand) ? 0.7 : 1.1);
  const double from = begin + raising;
  const double to = end - raising;
  add(clip, begin, from, 0, kActRaisedFrame);
  pieces_.back().moving = 1;
  if (act.cycle_s > 0) {
    const double wanted = (to - from) / steps(act.cycle_s * random_.uniform(0.8, 1.25));
    const int times = std::max(static_cast<int>(std::lround(wanted)), 1);
    for (int i = 0; i < times; ++i) {
      add(clip, from + (to - from) * i / times, from + (to - from) * (i + 1) / times,
          kActRaisedFrame, kActRaisedFrame + kActFrames - 1);
    }
  } else {
    constexpr double kReach = (kActFrames - 1) / 2.0;
    look_about(clip, kActRaisedFrame + 1 + kReach, kReach, from, to);
  }
  add(clip, to, end, kActRaisedFrame, 0);
  pieces_.back().moving = 1;
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
