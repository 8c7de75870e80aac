#include "skinning/animate/clips.h"

#include <cmath>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "skinning/animate/acts.h"
#include "skinning/animate/bearing.h"
#include "skinning/animate/gait.h"
#include "skinning/animate/motion.h"
#include "skinning/animate/sitting.h"
#include "skinning/animate/standing.h"

namespace throng::skinning {

namespace {

constexpr double kStandardStatureM = 1.7;
constexpr double kLookAside = 55 * kDegree;

// The speed at which a stride of this length is natural.
float natural_speed(double stride) {
  double low = 0;
  double high = 8;
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    const double length = stride_length_m(middle, kStandardStatureM) / kStandardStatureM;
    (length < stride ? low : high) = middle;
  }
  return static_cast<float>(low);
}

// Starts and stops are those of plain walking.
Gait estimate_gait(const std::string& name, double stride) {
  const BearingClips* clips = find_bearing(name);
  if (clips == nullptr) return {false, stride};
  return {clips->runs, stride, clips->bearing};
}

float stride_center(const std::string& name, double stride) {
  return stride > 0 ? static_cast<float>(middle(estimate_gait(name, stride))) : 0.0F;
}

class Catalog {
 public:
  void add(const std::string& name, std::uint32_t frames, bool cyclic = true, double stride = 0) {
    clips_.push_back({name, stride > 0 ? natural_speed(stride) : 0.0F, next_, frames,
                      static_cast<float>(stride), stride_center(name, stride), cyclic});
    next_ += frames;
  }
  std::vector<Clip> clips() && { return std::move(clips_); }

 private:
  std::vector<Clip> clips_;
  std::uint32_t next_ = 0;
};

// Frame `frame` of a clip as a share of it: of a cycle, or from the first frame to the last.
double cycle_share(const Clip& clip, std::uint32_t frame) {
  const std::uint32_t intervals = clip.cyclic ? clip.frames : clip.frames - 1;
  return static_cast<double>(frame) / std::max(intervals, 1U);
}

// A figure of a clip that raises something in its first half and then holds it.
Figure held(const Walker& walker, const Clip& clip, double share) {
  const double raised = std::min(2 * share, 1.0);
  const double phase = std::max(2 * share - 1, 0.0);
  if (clip.name == "phone") return look_at_phone(walker, raised, phase);
  if (clip.name == "look_up_left") return look_up(walker, kLookAside, raised, phase);
  if (clip.name == "look_up_right") return look_up(walker, -kLookAside, raised, phase);
  return look_up(walker, 0, raised, phase);
}

Figure acting_figure(const Walker& walker, const Act& act, double frame) {
  const double raised = frame / kActRaisedFrame;
  if (raised < 1) return act_figure(walker, act, raised, 0);
  // Calm acts are raised to the middle of their frames.
  const double first = kActRaisedFrame + (act.cycle_s > 0 ? 0 : 1);
  const double at = frame < first ? 0.5 : (frame - first) / (kActFrames - 1);
  return act_figure(walker, act, 1, act.cycle_s > 0 ? at : 2 * at - 1);
}

// Raised, then one wave.
Figure cheering_figure(const Walker& walker, const Clip& clip, double share) {
  const double frame = share * (clip.frames - 1);
  const double raised = std::min(frame / kCheerRaisedFrame, 1.0);
  const double waved = (frame - kCheerRaisedFrame) / (clip.frames - 1 - kCheerRaisedFrame);
  return cheer(walker, raised, std::max(waved, 0.0));
}

Figure standing_figure(const Walker& walker, const Clip& clip, double share) {
  if (clip.name == "idle") return stand(walker, 0, 2 * share - 1);
  if (clip.name == "idle_left") return stand(walker, 1, 2 * share - 1);
  if (clip.name == "idle_right") return stand(walker, -1, 2 * share - 1);
  if (clip.name == "turn_30") return turn_on_the_spot(walker, 30 * kDegree, share);
  if (clip.name == "turn_60") return turn_on_the_spot(walker, 60 * kDegree, share);
  if (clip.name == "turn_90") return turn_on_the_spot(walker, 90 * kDegree, share);
  if (const Act* act = find_act(clip.name)) {
    return acting_figure(walker, *act, share * (clip.frames - 1));
  }
  if (const auto seat = find_seat(clip.name)) return sit(walker, *seat, 2 * share - 1);
  if (clip.name == "rise") return rise(walker, share);
  if (clip.name == "cheer") return cheering_figure(walker, clip, share);
  return held(walker, clip, share);
}

// A character's own motion for a clip that moves forward; null for none.
const OwnMotion::Cycle* own_cycle(const OwnMotion& own, const Clip& clip) {
  const bool walks =
      clip.name == "walk" || clip.name.rfind("start", 0) == 0 || clip.name.rfind("stop", 0) == 0;
  if (walks && own.walk) return &*own.walk;
  return clip.name == "run" && own.run ? &*own.run : nullptr;
}

void add_strides(const BearingClips& bearing, Catalog& catalog) {
  for (int i = 0; i < bearing.count; ++i) {
    catalog.add(std::string(bearing.name), kClipFrames, true,
                bearing.first_stride + bearing.stride_interval * i);
  }
}

bool starts_with(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }

}  // namespace

std::vector<Clip> standard_clips() {
  Catalog catalog;
  for (const char* name : {"idle", "idle_left", "idle_right"}) catalog.add(name, 13, false);
  catalog.add("phone", 11, false);
  for (const char* name : {"look_up", "look_up_left", "look_up_right"}) {
    catalog.add(name, 9, false);
  }
  for (const char* name : {"turn_30", "turn_60", "turn_90"}) catalog.add(name, 12);
  for (const char* name : {"fall_forwards", "fall_backwards"}) catalog.add(name, 16, false);
  add_strides(*find_bearing("walk"), catalog);
  for (int i = 1; i < 18; i += 2) {
    const double stride = 0.22 + 0.04 * i;
    for (const char* name : {"start_left", "start_right"}) catalog.add(name, 6, false, stride);
    for (const char* name : {"stop_left", "stop_right"}) catalog.add(name, 4, false, stride);
  }
  for (const BearingClips& bearing : bearings()) {
    if (bearing.name != "walk") add_strides(bearing, catalog);
  }
  for (const std::string_view name : kSeatedClips) catalog.add(std::string(name), 13, false);
  catalog.add("rise", 9, false);
  catalog.add("cheer", kCheerRaisedFrame + 13, false);
  for (const Act& act : acts()) {
    const std::uint32_t gap = act.cycle_s > 0 ? 0 : 1;
    catalog.add(std::string(act.clip), kActRaisedFrame + gap + kActFrames, false);
  }
  return std::move(catalog).clips();
}

std::vector<Palette> bake_clip(const Walker& walker, const Clip& clip, const OwnMotion& own) {
  check(clip.frames > 0, "a clip has frames");
  std::vector<Palette> palettes;
  palettes.reserve(clip.frames);
  if (starts_with(clip.name, "fall")) {
    // Nobody lies on a backpack, on a case, or in a pram.
    const Carry carries = walker.manner.carries;
    const bool forwards = (clip.name == "fall_forwards" || carries == Carry::backpack ||
                           carries == Carry::suitcase) &&
                          carries != Carry::pram;
    for (std::uint32_t frame = 0; frame < clip.frames; ++frame) {
      const Pose pose = fall(walker, forwards, cycle_share(clip, frame));
      palettes.push_back(grounded(walker, pose, walker.body));
    }
    return palettes;
  }
  if (clip.stride <= 0) {
    for (std::uint32_t frame = 0; frame < clip.frames; ++frame) {
      const double share = cycle_share(clip, frame);
      const bool stands_as = starts_with(clip.name, "idle") && !own.idle.empty();
      // Ready in the middle, as everybody is.
      const Figure figure = stands_as ? stand_as(walker, own.idle, std::fmod(share + 0.5, 1))
                                      : standing_figure(walker, clip, share);
      const Act* act = find_act(clip.name);
      const Pose pose = solve(walker, figure);
      palettes.push_back(act != nullptr && is_airborne(*act)
                             ? pose_palette(walker.joints, pose)
                             : grounded(walker, pose, walker.soles));
    }
    return palettes;
  }
  const Stride stride(walker, estimate_gait(clip.name, clip.stride), own_cycle(own, clip));
  const Side side = clip.name.ends_with("right") ? Side::right : Side::left;
  for (std::uint32_t frame = 0; frame < clip.frames; ++frame) {
    const double share = cycle_share(clip, frame);
    Figure figure;
    bool touches = true;
    if (starts_with(clip.name, "start")) {
      figure = start(walker, stride, side, share);
    } else if (starts_with(clip.name, "stop")) {
      figure = stop(walker, stride, side, share);
    } else {
      figure = stride.at(share);
      touches = stride.supported(share);
    }
    const Pose pose = solve(walker, figure);
    palettes.push_back(touches ? grounded(walker, pose, walker.soles)
                               : pose_palette(walker.joints, pose));
  }
  return palettes;
}

}  // namespace throng::skinning
