// Detection of views that repeat another view and thus add no information.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/correspondences.h"

namespace throng::calibrate {

/// Max root mean square distance (px) of the pixels of shared points (at least half of each view's
/// points) at which a view counts as a repetition of another, as of a camera that was not moved.
inline constexpr double kRepeatedPx = 2;

/// For each view, the index of the first view that it repeats, or its own index.
std::vector<std::size_t> first_alike(const std::vector<View>& views);

/// The number of views that are not repetitions.
std::size_t distinct_views(const std::vector<View>& views);

/// Moves views whose points and pixels equal those of an earlier one, as of an image given twice,
/// to `left_out`.
void leave_out_copies(Correspondences& all);

}  // namespace throng::calibrate
