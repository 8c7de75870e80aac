// How many people a door passes at most in any stretch of time.
#pragma once

#include <string_view>

namespace throng::metrics {

/// At most `burst + rate_per_s * t` people pass in any t seconds.
struct DoorCapacity {
  double burst = 0;
  double rate_per_s = 0;
};

/// The 99.9 % quantile of the saturated flow of a pedestrian model (crowd/model.h; table and source
/// in the .cpp), as an envelope over windows of 1 s and more. Linear in the width between the
/// measured ones, in proportion to it beyond the widest; no door takes less than the narrowest one.
/// Any other name counts as `ttc`, which is what scenarios without a model of their own run
/// with.
DoorCapacity door_capacity(std::string_view model, double width_m);

}  // namespace throng::metrics
