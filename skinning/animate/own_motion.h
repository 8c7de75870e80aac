// The own motion of an imported character (walking, running, standing), which replaces the gait
// tables. For strides of other lengths than the clip's, the swing of the feet is scaled.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "skinning/animate/figure.h"

namespace throng::skinning {

/// One stride of a clip. Phases are in strides from the left foot's strike, as in gait.h; own
/// phases start at the strike of the respective foot.
class OwnGait {
 public:
  /// `poses` are evenly spaced over `duration_s` of a cyclic clip, on the spot or moving forward.
  /// The moment at which the left foot is below the body gets the phase `middle`. Throws
  /// std::invalid_argument if the left foot never passes below the body from front to back.
  OwnGait(const Walker& walker, const std::vector<Pose>& poses, double duration_s, double middle);

  double duration_s() const { return duration_s_; }  ///< duration of one stride
  /// Speed of the ground relative to the body while a foot stands.
  double foot_speed_mps() const { return foot_speed_mps_; }

  /// Pose of trunk and arms; the shift of the hips excludes the forward motion.
  Pose trunk(double phase) const;
  /// Mean vertical shift of the hips.
  double mean_height_m() const { return mean_height_m_; }
  /// Vector from the hip joint to the ankle (m).
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

  std::vector<Moment> moments_;  ///< moments of the whole clip
  double duration_s_;
  double strides_ = 1;  ///< number of strides in the clip
  double zero_ = 0;     ///< position in the clip of phase 0
  double foot_speed_mps_ = 0;
  double mean_height_m_ = 0;
};

/// The own clips of a character; strides in statures.
struct OwnMotion {
  struct Cycle {
    OwnGait gait;
    double stride;
  };
  std::optional<Cycle> walk;
  std::optional<Cycle> run;
  std::vector<Pose> idle;  ///< empty for none
};

/// Standing with trunk and arms of a cyclic sequence of poses; share 0 and 1 are ready().
Figure stand_as(const Walker& walker, const std::vector<Pose>& poses, double share);

}  // namespace throng::skinning
