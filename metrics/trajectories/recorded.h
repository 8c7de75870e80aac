// People as a trajectory file has them, before they become a trace.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::metrics {

/// Positions of all people, as read from a file.
struct Recorded {
  double frames_per_s = 0;
  double unit_m = 1;            ///< as stated in the file
  bool unit_is_stated = false;  ///< by the file or by its format
  std::map<std::int64_t, std::map<std::int64_t, Eigen::Vector2d>> places;  ///< by person and frame,
                                                                           ///< in the file's unit
  std::map<std::int64_t, std::string> names;  ///< of people whose ids in the file are words
  std::vector<Problem> notes;                 ///< warnings, such as what was left out
};

/// Expected in messages about a missing rate or unit, with the options that give it.
inline constexpr const char* kFrameRateExpected =
    "the number of frames per second: --frame-rate (in JSON \"frame_rate_hz\")";
inline constexpr const char* kUnitExpected =
    "the unit of length: --unit-m 0.01 for cm (in JSON \"unit\": \"cm\")";

}  // namespace throng::metrics
