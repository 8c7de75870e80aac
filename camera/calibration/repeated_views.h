// Views that show the object exactly where another one does: they add no information.
#pragma once

#include <cstddef>
#include <vector>

#include "camera/calibration/correspondences.h"

namespace throng::calibrate {

/// A view repeats another when the pixels of the points that both show (at least half of each) are
/// this near on the average (px, root mean square), as those of a camera that was not moved.
inline constexpr double kRepeatedPx = 2;

/// Per view, the first view that it repeats; its own index where it repeats none.
std::vector<std::size_t> first_alike(const std::vector<View>& views);

/// How many views are not repetitions.
std::size_t distinct_views(const std::vector<View>& views);

/// Moves views whose points and pixels are all those of an earlier one to `left_out`: the same
/// image given twice.
void leave_out_copies(Correspondences& all);

}  // namespace throng::calibrate
