// Positions at times, and their interpolation at the times of frames.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "metrics/trajectories/recorded.h"

namespace throng::metrics {

/// A person's places by time (s) or, where the file has frames, by frame.
using Track = std::map<double, Eigen::Vector2d>;

/// People whose keys are those of their tracks.
struct TimedPeople {
  std::vector<std::int64_t> ids;
  std::vector<Track> tracks;  ///< as many as ids
  /// Whether people are present between any of their times; else only in gaps of up to 1 s.
  bool spans_gaps = false;
};

/// Counts times from the first if they are those of a clock (Unix times in s, ms, µs or ns, which
/// their size tells), so that they become seconds. Times below 1e6 remain.
void count_from_first(std::vector<Track>& tracks);

/// Puts people on frames. The rate is `frames_per_s` or else that of find_frames() (frame_times.h).
/// Times that lie on frames within their rounding are those of the frames; others, which vary by
/// more, are interpolated at mean_rate(). Throws InputError if times have no regular step and no
/// rate is given.
Recorded put_on_frames(TimedPeople people, std::optional<double> frames_per_s,
                       const std::string& name);

}  // namespace throng::metrics
