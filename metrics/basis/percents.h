// The shares of people whose times are given.
#pragma once

#include <array>

namespace throng::metrics {

inline constexpr std::array kPercents = {25, 50, 75, 80, 90, 95, 99, 100};

}  // namespace throng::metrics
