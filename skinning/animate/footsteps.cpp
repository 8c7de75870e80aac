#include "skinning/animate/footsteps.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace throng::skinning {

namespace {

Side other(Side side) { return side == Side::left ? Side::right : Side::left; }

// Preferred steps if steps could have any length.
struct WishedStep {
  double length_m;
  std::string_view clip;
};

class Planner {
 public:
  Planner(const Trajectory& trajectory, const Stretch& stretch, const ClipSet& clips,
          const Pedestrian& pedestrian)
      : trajectory_(trajectory),
        stretch_(stretch),
        clips_(clips),
        pedestrian_(pedestrian),
        begin_m_(trajectory.distance_m(static_cast<double>(stretch.first))),
        end_m_(trajectory.distance_m(static_cast<double>(stretch.last))) {}

  Walk plan(bool from_rest, bool to_rest) {
    Walk walk{{}, from_rest, to_rest};
    side_ = pedestrian_.phase_offset < 0.5 ? Side::left : Side::right;
    // A person who is already walking is somewhere within a step.
    const double done =
        from_rest ? 0 : 2 * pedestrian_.phase_offset - std::floor(2 * pedestrian_.phase_offset);
    if (to_rest) {
      walk_to_rest(done, walk);
    } else {
      walk_on(done, walk);
    }
    return walk;
  }

 private:
  WishedStep wish_at(double at_m) {
    const double stature = pedestrian_.stature_m;
    const double ahead_m = at_m + 0.35 * stature;
    const double speed = trajectory_.speed_mps(at_m, ahead_m, stretch_.first, stretch_.last);
    const auto step =
        static_cast<std::size_t>(trajectory_.step_at(at_m, stretch_.first, stretch_.last));
    const Moment& moment = trajectory_.moments()[step];
    // A running person keeps running until clearly slower than at the start of the run
    // (hysteresis).
    double change = running_speed_mps(stature) * (runs_ ? 0.94 : 1.04);
    if (moment.panicked) change *= 0.8;
    runs_ = speed > change;
    std::string_view clip = pedestrian_.walk;
    if (runs_) {
      clip = moment.panicked ? pedestrian_.flight : "run";
    } else if (moment.panicked) {
      clip = "walk";
    } else if (moment.gaze == Gaze::ahead) {
      clip = "walk_look_up";
    }
    return {0.5 * pedestrian_.stride * stride_length_m(speed, stature, pedestrian_.age_years),
            clip};
  }

  // Steps up to the end of the path and beyond.
  void walk_on(double done, Walk& walk) {
    double walked_m = 0;
    while (begin_m_ + walked_m < end_m_) {
      WishedStep wish = wish_at(begin_m_ + walked_m);
      const bool at_rest = walk.steps.empty() && walk.from_rest;
      if (at_rest) rest_at(wish);
      walked_m +=
          add(wish.clip, wish.length_m, walk.steps.empty() ? done : 0, walked_m, at_rest, walk);
    }
    for (Footstep& step : walk.steps) step.begin_m += begin_m_;
  }

  std::vector<WishedStep> wish(double done) {
    std::vector<WishedStep> wishes;
    double at_m = begin_m_;
    while (at_m < end_m_) {
      wishes.push_back(wish_at(at_m));
      at_m += wishes.back().length_m * (wishes.size() == 1 ? 1 - done : 1);
    }
    return wishes;
  }

  // People start and stop walking, with steps of no more than this.
  void rest_at(WishedStep& step) const {
    constexpr double kMaxStepStatures = 0.43;  // statures
    step.clip = "walk";
    step.length_m = std::min(step.length_m, kMaxStepStatures * pedestrian_.stature_m);
  }

  static double total_m(const std::vector<WishedStep>& wishes, double done) {
    double sum = -done * wishes.front().length_m;
    for (const WishedStep& wish : wishes) sum += wish.length_m;
    return sum;
  }

  // As many steps as have to be stretched or shortened least.
  std::size_t count_that_fits(const std::vector<WishedStep>& wishes, double done) const {
    const double span_m = end_m_ - begin_m_;
    double sum = wishes.empty() ? 0 : -done * wishes.front().length_m;
    double best = 1e9;
    std::size_t best_count = 0;
    for (std::size_t count = 1; count <= wishes.size(); ++count) {
      sum += wishes[count - 1].length_m;
      const double misfit = std::abs(std::log(std::max(span_m, 1e-6) / std::max(sum, 1e-6)));
      if (misfit >= best) continue;
      best = misfit;
      best_count = count;
    }
    return best_count;
  }

  // Steps that end where the path does: each makes up for what the ones before were too long or too
  // short.
  void walk_to_rest(double done, Walk& walk) {
    std::vector<WishedStep> wishes = wish(done);
    wishes.resize(count_that_fits(wishes, done));
    if (wishes.empty()) return;
    if (walk.from_rest) rest_at(wishes.front());
    rest_at(wishes.back());
    if (wishes.size() > 1 && wishes[wishes.size() - 2].clip == pedestrian_.walk) {
      wishes[wishes.size() - 2].clip = "walk";
    }
    const double span_m = end_m_ - begin_m_;
    const double stretch = span_m / std::max(total_m(wishes, done), 1e-6);
    double wished_m = 0;
    double chosen_m = 0;
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      const double skipped = i == 0 ? done : 0;
      wished_m += (1 - skipped) * stretch * wishes[i].length_m;
      const bool at_rest = (i == 0 && walk.from_rest) || i + 1 == wishes.size();
      chosen_m += add(wishes[i].clip, (wished_m - chosen_m) / (1 - skipped), skipped, chosen_m,
                      at_rest, walk);
    }
    const double scale = chosen_m > 0 ? span_m / chosen_m : 1;
    for (Footstep& step : walk.steps) {
      step.begin_m = begin_m_ + scale * step.begin_m;
      step.length_m *= scale;
    }
  }

  // Adds a step of about this length and returns its length, less what of it is skipped.
  double add(std::string_view name, double length_m, double skipped, double at_m, bool at_rest,
             Walk& walk) {
    const Clip* before = walk.steps.empty() || at_rest ? nullptr : walk.steps.back().clip;
    const Clip& clip = choose_clip(name, length_m, before, at_rest);
    const double step_m = 0.5 * static_cast<double>(clip.stride) * pedestrian_.stature_m;
    walk.steps.push_back({&clip, side_, at_m - skipped * step_m, step_m});
    side_ = other(side_);
    return (1 - skipped) * step_m;
  }

  const Clip& choose_clip(std::string_view name, double length_m, const Clip* before,
                          bool at_rest) {
    const double stride = 2 * length_m / pedestrian_.stature_m;
    if (before != nullptr) {
      if (const Clip* other = change_bearing(name, stride, *before)) return *other;
    }
    // First and last steps have clips of their own, for fewer lengths.
    const Clip* rest = at_rest ? clips_.find("start_left", stride) : nullptr;
    const Clip& clip = clips_.nearest(name, rest != nullptr ? rest->stride : stride);
    // No change for nothing.
    constexpr double kHold = 0.7;
    if (before == nullptr || before->name != clip.name || before == &clip) return clip;
    const double kept = std::abs(before->stride - stride);
    const double apart = std::abs(before->stride - clip.stride);
    return kept < kHold * apart ? *before : clip;
  }

  /// The clip of a step that leads from one bearing of a walker to another, or cannot have the
  /// bearing; null for other steps. Bearings change between strides of one length, so that no foot
  /// slides while the arms move for a longer time.
  const Clip* change_bearing(std::string_view name, double stride, const Clip& before) const {
    constexpr double kMaxOff = 0.03;  // statures
    const std::string_view own = pedestrian_.walk;
    if (own == "walk" || !before.name.starts_with("walk")) return nullptr;
    if (name == "walk" && before.name == own) return &clips_.nearest("walk", before.stride);
    if (name != own) return nullptr;
    const Clip& wanted = clips_.nearest(own, stride);
    if (std::abs(wanted.stride - stride) > kMaxOff) {
      return &clips_.nearest("walk", before.name == own ? before.stride : stride);
    }
    if (before.name == own || before.stride == wanted.stride) return nullptr;
    return &clips_.nearest("walk", wanted.stride);
  }

  const Trajectory& trajectory_;
  const Stretch& stretch_;
  const ClipSet& clips_;
  const Pedestrian& pedestrian_;
  double begin_m_;
  double end_m_;
  bool runs_ = false;
  Side side_ = Side::left;
};

}  // namespace

Walk plan_walk(const Trajectory& trajectory, const Stretch& stretch, bool from_rest, bool to_rest,
               const ClipSet& clips, const Pedestrian& pedestrian) {
  return Planner(trajectory, stretch, clips, pedestrian).plan(from_rest, to_rest);
}

}  // namespace throng::skinning
