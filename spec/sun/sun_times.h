// Times of the day in words: "dusk", "noon", "sunset-20min".
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

/// The words; the sun is 0 or 6 degrees below the horizon at all of them but noon and midnight.
inline constexpr const char* kSunWordsPattern =
    "(midnight|dawn|sunrise|noon|sunset|dusk)( ?([+-]|\u2212) ?[0-9]+ ?(min|h))?";

/// Replaces words by times HH:MM in "environment.time_of_day" of a job and in its "randomize", for
/// the job's latitude and day. Adds a problem for words that are none, for times of other days, for
/// days on which the sun does not get there, and for words that depend on a sampled latitude or
/// day.
void resolve_sun_times(nlohmann::json& job, std::vector<Problem>& problems);

}  // namespace throng::jobs
