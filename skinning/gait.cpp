#include "skinning/gait.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/angle.h"
#include "skinning/gait_tables.h"
#include "skinning/motion.h"

namespace throng::skinning {

namespace {

constexpr double kPi = std::numbers::pi;

// Frames in which a stride is worked out before every fourth is kept.
constexpr int kFineFrames = 4 * static_cast<int>(kClipFrames);

double wrapped(double phase) { return phase - std::floor(phase); }

double wave(double phase) { return std::cos(2 * kPi * phase); }

// Periodic Catmull-Rom spline through a table whose last sample is its first.
double sample(const std::array<float, GaitTable::kSamples>& table, double phase) {
  constexpr int kCount = static_cast<int>(GaitTable::kSamples) - 1;
  const double at = wrapped(phase) * kCount;
  const int i = static_cast<int>(at) % kCount;
  const double t = at - std::floor(at);
  const auto value = [&](int k) -> double { return table[(i + k + kCount) % kCount]; };
  const double a = value(-1);
  const double b = value(0);
  const double c = value(1);
  const double d = value(2);
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// How one walks or runs at one speed.
struct Style {
  bool runs = false;
  double speed_mps = 0;
  double amplitude = 1;  // of the leg's swing against the measured one
};

// Share of the weight that a foot carries; the feet hand over while both are on the ground.
double support(const Style& style, double phase) {
  const double at = wrapped(phase);
  if (style.runs) return smooth(0, 0.05, at) * (1 - smooth(0.33, 0.38, at));
  return smooth(0, 0.12, at) * (1 - smooth(0.5, 0.62, at));
}

void pose_leg(const Style& style, Bone thigh, double phase, double roll_rad, Pose& pose) {
  const GaitTable& table = style.runs ? kRunTable : kWalkTable;
  // Faster walking swings the hips further but bends knees and ankles hardly more (Schwartz et
  // al. 2008); slower walking reduces both.
  const double joints = style.amplitude < 1 ? style.amplitude : 1 + 0.15 * (style.amplitude - 1);
  const double hip = style.amplitude * (sample(table.hip, phase) - table.pelvis_tilt_deg);
  const double knee = joints * sample(table.knee, phase);
  const double ankle = joints * sample(table.ankle, phase);
  const double foot = hip - knee + ankle;
  // The toes stay flat while the heel rises.
  const double at = wrapped(phase);
  const double toe_off = style.runs ? 0.38 : 0.62;
  const double planted = smooth(0.1, 0.2, at) * (1 - smooth(toe_off, toe_off + 0.12, at));
  const double toes = foot + planted * std::clamp(-foot, 0.0, 35.0);

  const std::size_t first = index_of(thigh);
  const Eigen::Matrix3f roll = turn_x(roll_rad);
  pose.rotation[first] = roll * turn_y(-hip * kDegree);
  pose.rotation[first + 1] = roll * turn_y(-(hip - knee) * kDegree);
  pose.rotation[first + 2] = turn_y(-foot * kDegree);
  pose.rotation[first + 3] = turn_y(-toes * kDegree);
}

struct ArmSwing {
  double shoulder_deg;
  double elbow_deg;
  double out_deg;
  double inward_deg;
};

void pose_arm(const ArmSwing& swing, Bone upper_arm, double chest_yaw_rad, Pose& pose) {
  const double side = upper_arm == Bone::left_upper_arm ? 1 : -1;
  const Eigen::Matrix3f base = turn_z(chest_yaw_rad) * turn_x(side * swing.out_deg * kDegree);
  const std::size_t first = index_of(upper_arm);
  pose.rotation[first] = base * turn_y(-swing.shoulder_deg * kDegree);
  pose.rotation[first + 1] = base * turn_z(-side * swing.inward_deg * kDegree) *
                             turn_y(-(swing.shoulder_deg + swing.elbow_deg) * kDegree);
  pose.rotation[first + 2] = pose.rotation[first + 1];
}

// The arm swings against the leg of its side.
ArmSwing arm_swing(const Style& style, double phase) {
  const double forward = -wave(phase);
  if (style.runs) return {-8 + 25 * forward, 82 + 17 * forward, 6, 22};
  const double reach = std::clamp(8 + 8 * style.speed_mps, 8.0, 24.0);
  return {1 + reach * forward, 16 + 0.5 * reach * forward, 0, 4};
}

double leg_length(const Joints& joints) {
  return (joints[index_of(Bone::left_shin)] - joints[index_of(Bone::left_thigh)]).norm() +
         (joints[index_of(Bone::left_foot)] - joints[index_of(Bone::left_shin)]).norm();
}

void pose_trunk(double pelvis_yaw_rad, double chest_yaw_rad, double tilt_rad, double lean_rad,
                Pose& pose) {
  pose.of(Bone::hips) = turn_z(pelvis_yaw_rad) * turn_x(tilt_rad) * turn_y(0.3 * lean_rad);
  pose.of(Bone::spine) = turn_z(0.5 * (pelvis_yaw_rad + chest_yaw_rad)) * turn_x(0.3 * tilt_rad) *
                         turn_y(0.8 * lean_rad);
  pose.of(Bone::chest) = turn_z(chest_yaw_rad) * turn_y(lean_rad);
  pose.of(Bone::left_clavicle) = pose.of(Bone::right_clavicle) = pose.of(Bone::chest);
  pose.of(Bone::neck) = turn_z(0.3 * chest_yaw_rad) * turn_y(0.7 * lean_rad);
  pose.of(Bone::head) = turn_y(0.2 * lean_rad);
}

Pose stride_pose(const Walker& walker, const Style& style, double phase) {
  Pose pose;
  const double vigour = std::min(style.amplitude, 1.2);
  const double yaw = -(style.runs ? 7.0 : 5.0) * kDegree * vigour * wave(phase);
  const double tilt = (style.runs ? 4.5 : 3.5) * kDegree * vigour * wave(phase - 0.15);
  const double lean = (style.runs ? 7.0 : 2.5) * kDegree;
  pose_trunk(yaw, -1.2 * yaw, tilt, lean, pose);
  // The hips swing over the foot that stands; the legs slant so that the feet do not.
  const double sway_m = (style.runs ? 0.008 : 0.018) * walker.stature_m / 1.76 * wave(phase - 0.3);
  pose.shift.y() = static_cast<float>(sway_m);
  const double roll = -sway_m / leg_length(walker.joints);
  pose_leg(style, Bone::left_thigh, phase, roll, pose);
  pose_leg(style, Bone::right_thigh, phase + 0.5, roll, pose);
  pose_arm(arm_swing(style, phase), Bone::left_upper_arm, -1.2 * yaw, pose);
  pose_arm(arm_swing(style, phase + 0.5), Bone::right_upper_arm, -1.2 * yaw, pose);
  return pose;
}

Pose idle_pose(const Walker& walker, double phase) {
  Pose pose;
  const double breath = wave(2 * phase);
  pose_trunk(0.01 * wave(phase), 0.02 * wave(phase + 0.1), 0.012 * wave(phase + 0.25),
             0.018 + 0.008 * breath, pose);
  pose.of(Bone::head) = turn_z(0.22 * wave(phase + 0.4)) * turn_y(0.03 * wave(phase));
  const double sway_m = 0.012 * wave(phase + 0.25);
  pose.shift.y() = static_cast<float>(sway_m);
  const double roll = -sway_m / leg_length(walker.joints);
  for (const Bone thigh : {Bone::left_thigh, Bone::right_thigh}) {
    const std::size_t first = index_of(thigh);
    pose.rotation[first] = pose.rotation[first + 1] = turn_x(roll);
  }
  const ArmSwing arms = {1 + 1.5 * breath, 9 + 2 * wave(phase + 0.3), 0, 4};
  pose_arm(arms, Bone::left_upper_arm, 0, pose);
  pose_arm(arms, Bone::right_upper_arm, 0, pose);
  return pose;
}

// Where the ball of the left foot is against the hips, forwards, through a stride. The right
// foot's is the same half a stride later.
std::vector<double> ball_track(const Walker& walker, const Style& style) {
  std::vector<double> track(kFineFrames);
  for (int frame = 0; frame < kFineFrames; ++frame) {
    const Pose pose = stride_pose(walker, style, static_cast<double>(frame) / kFineFrames);
    track[frame] = pose_joints(walker.joints, pose)[index_of(Bone::left_toe)].x();
  }
  return track;
}

// How fast the hips have to move forwards, in metres per frame, for the feet that carry weight to
// stand still; where nothing carries, they keep the mean speed.
std::vector<double> hip_advance(const Walker& walker, const Style& style, double mean_m) {
  const std::vector<double> track = ball_track(walker, style);
  const auto step = [&](int frame) {
    return track[(frame + 1) % kFineFrames] - track[frame % kFineFrames];
  };
  std::vector<double> advance(kFineFrames);
  for (int frame = 0; frame < kFineFrames; ++frame) {
    const double middle = (frame + 0.5) / kFineFrames;
    const double left = support(style, middle);
    const double right = support(style, middle + 0.5);
    advance[frame] =
        mean_m + left * (-step(frame) - mean_m) + right * (-step(frame + kFineFrames / 2) - mean_m);
  }
  return advance;
}

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

// The swing of the legs with which the standing foot moves back just as fast as the ground.
double solve_amplitude(const Walker& walker, Style style, double stride_m) {
  double low = 0.1;
  double high = 2;
  constexpr int kSteps = 16;
  for (int step = 0; step < kSteps; ++step) {
    style.amplitude = 0.5 * (low + high);
    const double travel = total(hip_advance(walker, style, stride_m / kFineFrames));
    (travel < stride_m ? low : high) = style.amplitude;
  }
  return 0.5 * (low + high);
}

float lowest_sole(const Walker& walker, const Palette& palette) {
  float lowest = std::numeric_limits<float>::max();
  for (const Vertex& vertex : walker.soles) {
    lowest = std::min(lowest, skin(vertex, palette, palette, 0).z());
  }
  return walker.soles.empty() ? 0 : lowest;
}

Palette grounded_palette(const Walker& walker, const Pose& pose) {
  Palette palette = pose_palette(walker.joints, pose);
  const float lowest = lowest_sole(walker, palette);
  for (BoneMatrix& matrix : palette) matrix(2, 3) -= lowest;
  return palette;
}

std::vector<Palette> bake_standing(const Walker& walker, std::uint32_t frames) {
  std::vector<Palette> palettes;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    palettes.push_back(grounded_palette(walker, idle_pose(walker, double(frame) / frames)));
  }
  return palettes;
}

std::vector<Palette> bake_stride(const Walker& walker, const Clip& clip) {
  Style style{clip.name == "run", clip.speed_mps, 1};
  const double stride_m = stride_length_m(clip.speed_mps, walker.stature_m);
  style.amplitude = solve_amplitude(walker, style, stride_m);
  const std::vector<double> advance = hip_advance(walker, style, stride_m / kFineFrames);
  const double mean = total(advance) / kFineFrames;
  // The hips surge a little forwards and back around their mean speed.
  std::vector<double> surge(kFineFrames, 0);
  for (int frame = 1; frame < kFineFrames; ++frame) {
    surge[frame] = surge[frame - 1] + advance[frame - 1] - mean;
  }
  const double middle = total(surge) / kFineFrames;
  std::vector<Palette> palettes;
  for (std::uint32_t frame = 0; frame < clip.frames; ++frame) {
    const double phase = static_cast<double>(frame) / clip.frames;
    Pose pose = stride_pose(walker, style, phase);
    const auto fine = static_cast<std::size_t>(phase * kFineFrames);
    pose.shift.x() = static_cast<float>(surge[fine] - middle);
    palettes.push_back(grounded_palette(walker, pose));
  }
  return palettes;
}

}  // namespace

std::vector<Clip> standard_clips() {
  std::vector<Clip> clips = {{"idle", 0, 0, kClipFrames}};
  const auto add = [&](const char* name, float speed_mps) {
    clips.push_back({name, speed_mps, clips.back().first + clips.back().frames, kClipFrames});
  };
  for (const float speed :
       {0.3F, 0.4F, 0.5F, 0.62F, 0.75F, 0.9F, 1.05F, 1.2F, 1.35F, 1.5F, 1.67F, 1.85F, 2.0F}) {
    add("walk", speed);
  }
  for (const float speed : {2.15F, 2.4F, 2.7F, 3.0F, 3.4F, 3.8F, 4.3F, 4.9F}) add("run", speed);
  return clips;
}

std::vector<Palette> bake_clip(const Walker& walker, const Clip& clip) {
  return clip.name == "idle" ? bake_standing(walker, clip.frames) : bake_stride(walker, clip);
}

Walker walker_of(const Joints& joints, float stature_m, const Mesh& level) {
  Walker walker{joints, stature_m, {}};
  const auto is_foot = [](std::uint8_t bone) {
    const auto named = static_cast<Bone>(bone);
    return named == Bone::left_foot || named == Bone::left_toe || named == Bone::right_foot ||
           named == Bone::right_toe;
  };
  for (const Vertex& vertex : level.vertices) {
    int share = 0;
    for (std::size_t slot = 0; slot < 4; ++slot) {
      if (is_foot(vertex.bones[slot])) share += vertex.weights[slot];
    }
    if (share > 127) walker.soles.push_back(vertex);
  }
  return walker;
}

}  // namespace throng::skinning
