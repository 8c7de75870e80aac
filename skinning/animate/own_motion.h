// Motion that a character brings along, in place of the gait tables: its own gait, running and
// standing. Strides of other lengths than the clip's swing the feet further or less.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "skinning/animate/figure.h"

namespace throng::skinning {

/// One stride of a clip. Phases are in strides from the left foot's strike, as in gait.h; own
/// phases count from the strike of the foot in question.
class OwnGait {
 public:
  /// `poses` are evenly spaced over `duration_s` of a clip that begins again where it ends, on the
  /// spot or getting on. The stride starts where the left foot stands below the body, which is
  /// phase `middle`. Throws std::invalid_argument, saying what it found, when the left foot never
  /// passes below the body from front to back.
  OwnGait(const Walker& walker, const std::vector<Pose>& poses, double duration_s, double middle);

  double duration_s() const { return duration_s_; }  ///< of one stride
  /// How fast the ground passes under the standing foot.
  double foot_speed_mps() const { return foot_speed_mps_; }

  /// Trunk and arms; the hips' shift without what gets on.
  Pose trunk(double phase) const;
  /// Height of the hips' shift, on average.
  double mean_height_m() const { return mean_height_m_; }
  /// From the hip joint to the ankle.
  Eigen::Vector3f leg(Side side, double own_phase) const;
  /// Pitch of the foot; positive: toes up.
  double pitch_rad(Side side, double own_phase) const;

 private:
  struct Moment {
    Pose pose;
    std::array<Eigen::Vector3f, 2> leg;
    std::array<double, 2> pitch_rad;
  };
  struct Blend;
  void find_stride(const Walker& walker, const std::vector<Joints>& joints, double middle);
  Blend place(double phase) const;

  std::vector<Moment> moments_;  ///< over the whole clip
  double duration_s_;
  double strides_ = 1;  ///< in the clip
  double zero_ = 0;     ///< position in the clip of phase 0
  double foot_speed_mps_ = 0;
  double mean_height_m_ = 0;
};

/// A character's own clips; strides in statures.
struct OwnMotion {
  struct Cycle {
    OwnGait gait;
    double stride;
  };
  std::optional<Cycle> walk;
  std::optional<Cycle> run;
  std::vector<Pose> idle;  ///< empty for none
};

/// Standing with the trunk and arms of poses that begin again where they end; share 0 and 1 are
/// ready().
Figure stand_as(const Walker& walker, const std::vector<Pose>& poses, double share);

}  // namespace throng::skinning
