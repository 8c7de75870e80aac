// The percentages of people for which percentiles of times are computed.
#pragma once

#include <array>

namespace throng::metrics {

inline constexpr std::array kPercents = {25, 50, 75, 80, 90, 95, 99, 100};

}  // namespace throng::metrics
