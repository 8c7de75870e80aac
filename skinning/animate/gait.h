// Walking and running: joint angles from published measurements, applied to a character's limbs so
// that standing feet stay in place while the body moves over them.
#pragma once

#include "skinning/animate/bearing.h"
#include "skinning/animate/figure.h"
#include "skinning/animate/own_motion.h"

namespace throng::skinning {

/// A gait.
struct Gait {
  bool runs = false;
  double stride = 0.8;  ///< length of a stride (two steps), in statures
  Bearing bearing = Bearing::free;
};

/// Share of a stride during which a foot is on the ground: Winiarski 2019 (walking), Fukuchi 2017
/// (running; decreases with speed).
double duty(const Gait& gait);

/// Phase at which the left foot's toe joint is below the same point of the body as in standing, so
/// that clips can be joined there. Runners place their feet further back.
double middle(const Gait& gait);
inline constexpr double kWalkMiddle = 0.25;

/// One stride of a character. Phases are in strides from the left foot's strike. The character's
/// own cycle (if not null, it must outlive this object) replaces the measured gait.
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
  double swing_;  ///< amplitude of the hips relative to the measured gait
  double bend_;   ///< amplitude of knees and ankles relative to the measured gait
  double duty_;
  /// Height of the hips: mean, and cosine and sine terms over a step.
  std::array<double, 3> height_m_{};
};

}  // namespace throng::skinning
