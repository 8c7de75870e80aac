#include "skinning/animate/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/compute/random.h"
#include "base/error.h"
#include "base/geometry/smoothstep.h"
#include "skinning/animate/bearing.h"
#include "skinning/animate/footsteps.h"
#include "skinning/animate/rest.h"
#include "skinning/animate/standing.h"
#include "skinning/items.h"

namespace throng::skinning {

namespace {

// Share of a stride over which one gait blends into another.
constexpr double kChangeStrides = 0.15;

double half(Side side) { return side == Side::left ? 0.0 : 0.5; }

// The frame, as a phase from the middle of the left foot's stance on, at which clips change.
double switch_phase(const Clip& clip) {
  return std::ceil(clip.middle * static_cast<float>(clip.frames)) /
         static_cast<double>(clip.frames);
}

// Position along the path of a phase of a step's clip; the middle of the step is its beginning.
double place_m(const Footstep& step, double phase) {
  return step.begin_m + 2 * step.length_m * (phase - static_cast<double>(step.clip->middle));
}

// The phase after so many strides, rounded to a whole number of frames.
double after(const Clip& clip, double strides) {
  const auto frames = static_cast<double>(clip.frames);
  return std::max(std::round(strides * frames), 1.0) / frames;
}

std::uint32_t palette(const Clip& clip, double frame) {
  return blend_frame(clip, std::round(frame)).a;
}

std::uint32_t ready_palette(const ClipSet& clips) {
  const Clip& idle = clips.nearest("idle");
  return idle.first + ready_frame(idle);
}

// Lays the pieces of a walk, in order.
class WalkLayer {
 public:
  WalkLayer(const Trajectory& trajectory, const Stretch& stretch, const ClipSet& clips,
            std::vector<Piece>& pieces)
      : trajectory_(trajectory), stretch_(stretch), clips_(clips), pieces_(pieces) {}

  void lay(const Walk& walk) {
    for (std::size_t i = 0; i < walk.steps.size(); ++i) {
      const Footstep& step = walk.steps[i];
      if (i == 0 && walk.from_rest) {
        start(step);
      } else if (i == 0) {
        start_within(step);
      } else if (step.clip != walk.steps[i - 1].clip) {
        change(*walk.steps[i - 1].clip, step);
      }
      const bool stops = walk.to_rest && i + 1 == walk.steps.size();
      if (stops) {
        stop(step);
      } else {
        continue_walk(step, switch_phase(*step.clip) + 0.5);
      }
    }
  }

 private:
  // A piece up to a position on the path; without a clip, a blend between two palettes.
  void add(const Clip* clip, double frame, double to_frame, double to_m) {
    const bool goes_on = clip != nullptr && clip->cyclic && !pieces_.empty() &&
                         pieces_.back().clip == clip && pieces_.back().by_distance &&
                         pieces_.back().to_frame == frame;
    if (goes_on) {
      Piece& last = pieces_.back();
      // Only strides of one length: the frames stay in step with the path.
      last.to_frame = to_frame;
      last.to = to_m;
    } else {
      pieces_.push_back({trajectory_.step_at(at_m_, stretch_.first, stretch_.last), at_m_, to_m,
                         frame, to_frame, clip, true});
    }
    at_m_ = to_m;
  }

  // In the middle of a step.
  void start_within(const Footstep& step) {
    at_m_ = trajectory_.distance_m(static_cast<double>(stretch_.first));
    const double done = (at_m_ - step.begin_m) / (2 * step.length_m);
    frame_ = (step.clip->middle + half(step.side) + done) * step.clip->frames;
  }

  void start(const Footstep& step) {
    const Clip& clip = *step.clip;
    at_m_ = step.begin_m;
    const Clip* start =
        clips_.find(step.side == Side::left ? "start_left" : "start_right", clip.stride);
    if (start != nullptr && start->stride == clip.stride) {
      add(start, 0, start->frames - 1, place_m(step, clip.middle + 0.25));
      frame_ = (clip.middle + 0.25 + half(step.side)) * clip.frames;
    } else {
      const double phase = switch_phase(clip) + after(clip, kChangeStrides);
      frame_ = (phase + half(step.side)) * clip.frames;
      add(nullptr, ready_palette(clips_), palette(clip, frame_), place_m(step, phase));
    }
  }

  void change(const Clip& from, const Footstep& step) {
    const Clip& clip = *step.clip;
    const bool alike = clip.name == from.name;
    const double phase =
        switch_phase(clip) + (alike ? 1.0 / clip.frames : after(clip, kChangeStrides));
    const std::uint32_t from_palette = palette(from, frame_);
    frame_ = (phase + half(step.side)) * clip.frames;
    add(nullptr, from_palette, palette(clip, frame_), place_m(step, phase));
  }

  // On in the step's clip, to a phase of it.
  void continue_walk(const Footstep& step, double phase) {
    const double frame = (phase + half(step.side)) * step.clip->frames;
    // Positions grow for ever within a piece: whole strides make no difference.
    const double frames = step.clip->frames;
    const double to_frame = frame + frames * std::round((frame_ + 0.25 * frames - frame) / frames);
    add(step.clip, frame_, to_frame, place_m(step, phase));
    frame_ = to_frame;
  }

  void stop(const Footstep& step) {
    const Clip& clip = *step.clip;
    const Side side = step.side == Side::left ? Side::right : Side::left;  // that stands at the end
    const double phase = std::round((clip.middle + 0.5 - kStopStrides) * clip.frames) / clip.frames;
    if (place_m(step, phase) > at_m_) continue_walk(step, phase);
    const double end_m = step.begin_m + step.length_m;
    const Clip* stop = clips_.find(side == Side::left ? "stop_left" : "stop_right", clip.stride);
    if (stop != nullptr && stop->stride == clip.stride) {
      add(stop, 0, stop->frames - 1, end_m);
    } else {
      add(nullptr, palette(clip, frame_), ready_palette(clips_), end_m);
    }
  }

  const Trajectory& trajectory_;
  const Stretch& stretch_;
  const ClipSet& clips_;
  std::vector<Piece>& pieces_;
  double frame_ = 0;  ///< of the step's clip, where the walk goes on
  double at_m_ = 0;   ///< end of the last piece
};

struct ClipActions {
  std::string_view prefix;  ///< of the clip's name
  Actions actions;
};
constexpr std::array kClipActions = {
    ClipActions{"phone", Actions(Action::stand, Action::use_phone)},
    ClipActions{"look_up", Actions(Action::stand, Action::look_at_drone)},
    ClipActions{"turn_", Actions(Action::turn)},
    ClipActions{"start_", Actions(Action::walk)},
    ClipActions{"stop_", Actions(Action::walk)},
};

/// The actions during a piece of a fall: played forward it is falling, backward getting up, and a
/// still one is lying.
Actions fall_actions(const Piece& piece) {
  if (piece.to_frame > piece.frame) return Actions(Action::fall);
  return piece.to_frame < piece.frame ? Actions(Action::get_up) : Actions(Action::lie);
}

/// Whether a piece of standing ends with the head turned far to a side.
bool looks_around(const Piece& piece) {
  const double middle = ready_frame(*piece.clip);
  return piece.clip->name.starts_with("idle") &&
         std::abs(piece.to_frame - middle) > std::max(0.45 * middle, 1.0);
}

Actions actions_during(const Piece& piece) {
  // The blend at the end of a walk goes to standing.
  if (piece.clip == nullptr) return Actions(piece.by_distance ? Action::walk : Action::stand);
  if (looks_around(piece)) return Actions(Action::stand, Action::look_around);
  if (piece.clip->name.starts_with("fall_")) return fall_actions(piece);
  if (const Act* act = find_act(piece.clip->name)) return act->actions;
  if (const BearingClips* clips = find_bearing(piece.clip->name)) return clips->actions;
  for (const ClipActions& known : kClipActions) {
    if (piece.clip->name.starts_with(known.prefix)) return known.actions;
  }
  return Actions(Action::stand);
}

}  // namespace

MotionPlan::MotionPlan(const Population& population, const Appearance& appearance,
                       std::uint64_t key, std::span<const Moment> moments, double dt_s)
    : dt_s_(dt_s), phase_(appearance.phase_offset) {
  check(appearance.character < population.characters.size(), "the population has the character");
  const Character& character = population.characters[appearance.character];
  const ClipSet clips(population);
  Trajectory trajectory(moments, dt_s);
  Random random(key, Stream::motion);
  Random choice(key, Stream::motion, 2);
  const bool has_free_hands = has_both_hands(character.carries);
  const Setting setting = moments.empty() ? Setting::alone : moments.front().setting;
  const Pedestrian pedestrian{character.gait_stature_m(),
                              character.age_years,
                              static_cast<double>(appearance.amplitude) / appearance.cadence,
                              appearance.phase_offset,
                              choose_walk(setting, character.age_years, has_free_hands, choice),
                              choose_flight(has_free_hands, choice)};
  RestLayer rest(trajectory, clips, {character.age_years, has_free_hands, appearance.phase_offset},
                 random, pieces_);
  const std::vector<Stretch>& stretches = trajectory.stretches();
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& stretch = stretches[i];
    const bool first = i == 0;
    const bool last = i + 1 == stretches.size();
    if (stretch.activity == Activity::lying) {
      rest.lie(stretch, first, last);
    } else if (stretch.activity == Activity::standing) {
      rest.stand(stretch, first, last);
    } else {
      const Walk walk = plan_walk(trajectory, stretch, !first, !last, clips, pedestrian);
      if (walk.steps.empty()) {
        rest.stand(stretch, first, last);
      } else {
        WalkLayer(trajectory, stretch, clips, pieces_).lay(walk);
      }
    }
  }
  distance_m_ = std::move(trajectory).take_distances();
}

std::vector<Piece>::const_iterator MotionPlan::piece_at(double step) const {
  const auto next =
      std::upper_bound(pieces_.begin(), pieces_.end(), step,
                       [](double at, const Piece& piece) { return at < piece.begin; });
  return next == pieces_.begin() ? next : next - 1;
}

Actions MotionPlan::actions_at(double step) const {
  auto piece = piece_at(step);
  while (piece->clip == nullptr && piece->by_distance && piece + 1 != pieces_.end()) ++piece;
  return actions_during(*piece);
}

PoseBlend MotionPlan::at(double step) const {
  step = std::clamp(step, 0.0, static_cast<double>(distance_m_.size() - 1));
  const Piece& piece = *piece_at(step);
  const double driver = piece.by_distance ? at_step(distance_m_, step) : step;
  const double length = piece.to - piece.from;
  const double done = length > 0 ? std::clamp((driver - piece.from) / length, 0.0, 1.0) : 1.0;
  const double share = piece.moving > 0 ? geometry::smoothstep(done / piece.moving) : done;
  if (piece.clip == nullptr) {
    return {static_cast<std::uint32_t>(piece.frame), static_cast<std::uint32_t>(piece.to_frame),
            static_cast<float>(share)};
  }
  double frame = piece.frame + share * (piece.to_frame - piece.frame);
  if (piece.sway > 0) {
    const double ends = geometry::smoothstep(6 * done) * geometry::smoothstep(6 * (1 - done));
    frame += piece.sway * ends * sway_at(step * dt_s_, phase_);
  }
  return blend_frame(*piece.clip, frame);
}

}  // namespace throng::skinning
