// The max number of people who pass a door in a time interval.
#pragma once

#include <string_view>

namespace throng::metrics {

/// An arrival curve: at most burst + rate_per_s * t people pass in any t seconds.
struct DoorCapacity {
  double burst = 0;
  double rate_per_s = 0;
};

/// The capacity of a door: the 99.9 % quantile of the saturated flow of a pedestrian model
/// (crowd/state/model.h; table and source in the .cpp), as an envelope over windows of 1 s and
/// more. Interpolated between the measured widths, proportional to the width above the largest,
/// constant below the smallest. Unknown models count as `ttc`, the default model.
DoorCapacity door_capacity(std::string_view model, double width_m);

}  // namespace throng::metrics
