// How people walk and run: joint angles from published measurements, put on a character's own limbs
// so that the feet that stand do so in their place while the body passes over them.
#pragma once

#include "skinning/animate/figure.h"
#include "skinning/animate/own_motion.h"

namespace throng::skinning {

/// A gait.
struct Gait {
  bool runs = false;
  double stride = 0.8;    ///< length of a stride (two steps), in statures
  bool panics = false;    ///< arms up and out, leaning forwards
  bool looks_up = false;  ///< at something in the sky ahead
};

/// Share of a stride that a foot is on the ground: Winiarski 2019 (walking), Fukuchi 2017
/// (running; less the faster).
double duty(const Gait& gait);

/// Phase at which the left foot's toe joint is under the same point of the body as in standing:
/// there one clip can follow another. Runners put their feet down further back.
double middle(const Gait& gait);
inline constexpr double kWalkMiddle = 0.25;

/// One stride of one character. Phases are in strides from the left foot's strike. A character's
/// own cycle, if it has one (it must outlive this), stands in for the measured gait.
class Stride {
 public:
  Stride(const Walker& walker, const Gait& gait, const OwnMotion::Cycle* own = nullptr);

  Figure at(double phase) const;
  /// Whether any foot touches the ground.
  bool supported(double phase) const;
  double length_m() const { return gait_.stride * walker_->stature_m; }

 private:
  Pose trunk_at(double phase) const;
  Foot foot_at(Side side, double own_phase, const Pose& pose) const;
  Foot stance_foot(Side side, double own_phase) const;
  Foot swung_foot(Side side, double own_phase, const Pose& pose) const;
  double pitch_rad(Side side, double own_phase) const;
  double measured_pitch_deg(Side side, double own_phase) const;
  Pose own_trunk_at(double phase) const;
  double hip_height_m(double phase, Side side, double own_phase, double knee_rad) const;
  void settle_walking_height();
  void settle_running_height();
  double excess_height_m() const;

  const Walker* walker_;
  Gait gait_;
  const OwnMotion::Cycle* own_;
  double swing_;  ///< of the hips against the measured gait
  double bend_;   ///< of knees and ankles against the measured gait
  double duty_;
  std::array<double, 3> height_m_{};  ///< of the hips: mean, and cosine and sine over a step
};

}  // namespace throng::skinning
