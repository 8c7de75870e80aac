// Bearing: what people do with arms and head while they walk or run, each with clips of its own,
// and who walks or flees how.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/compute/random.h"
#include "skinning/animate/action.h"
#include "skinning/animate/acts.h"
#include "skinning/animate/posture.h"

namespace throng::skinning {

enum class Bearing : std::uint8_t {
  free,     ///< arms swing
  look_up,  ///< at an object in the sky ahead
  phone,
  call,
  pockets,
  talk,
  arms_up,    ///< and out, leaning forward, in panic
  cover,      ///< hands over the head, in panic
  look_back,  ///< over the shoulder, in panic
};

/// The clips of one bearing.
struct BearingClips {
  std::string_view name;
  Bearing bearing;
  bool runs;
  Actions actions;
  int count;               ///< of clips, for strides of different length
  double first_stride;     ///< statures
  double stride_interval;  ///< statures
};

/// All bearings.
std::span<const BearingClips> bearings();

/// The bearing of a clip; null for other clips.
const BearingClips* find_bearing(std::string_view clip);

/// Changes trunk and head for a bearing.
void bear_trunk(Bearing bearing, double phase, Trunk& trunk);

/// Puts the arms of a posed walker as a bearing has them; `phase` is that of the stride.
void bear_arms(const Walker& walker, Bearing bearing, double phase, Pose& pose);

/// The name of the clips by which somebody walks, and flees, drawn at random.
std::string_view choose_walk(Setting setting, double age_years, bool has_free_hands,
                             Random& random);
std::string_view choose_flight(bool has_free_hands, Random& random);

}  // namespace throng::skinning
