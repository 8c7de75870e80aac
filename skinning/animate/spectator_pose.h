// Poses of people on a stand from what they do now and did before, without a plan.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "skinning/animate/action.h"
#include "skinning/animate/motion.h"
#include "skinning/animate/sitting.h"
#include "skinning/population.h"

namespace throng::skinning {

/// The posture of somebody on a stand.
enum class StandPosture : std::uint8_t { sitting, standing, cheering };

/// A time, seen from the changes of posture around it.
struct PostureTime {
  StandPosture now = StandPosture::sitting;
  StandPosture before = StandPosture::sitting;               ///< `now` if there was no change
  double since_s = 0;                                        ///< since then
  double until_s = std::numeric_limits<double>::infinity();  ///< until the next change, if known
};

/// The poses of a library for stands. Libraries without these clips give standing people.
class SpectatorPoses {
 public:
  /// The population must outlive this object.
  explicit SpectatorPoses(const Population& population);

  /// The pose of a person with this phase (0 to 1), which tells people apart. Continuous within a
  /// person's time, if changes are known beforehand.
  PoseBlend at(const PostureTime& posture, double phase, double time_s) const;
  /// The actions to which the pose of a person with this phase belongs.
  static Actions actions(const PostureTime& posture, double phase);

 private:
  PoseBlend seated(const PostureTime& posture, double phase, double time_s) const;
  PoseBlend upright(const PostureTime& posture, double phase, double time_s) const;

  ClipSet clips_;
  std::array<const Clip*, kSeatedClips.size()> seated_{};
  const Clip* rise_;
  const Clip* cheer_;
  const Clip* idle_;
};

}  // namespace throng::skinning
