// The frame rate behind times that a file rounds.
#pragma once

#include <optional>
#include <vector>

namespace throng::metrics {

/// Frames at a constant rate: frame k is at (k + phase) / rate.
struct FrameTimes {
  double frames_per_s = 0;
  double phase = 0;  ///< of a frame, -0.5 to 0.5
};

/// Times at which there is anybody, in s, ascending and different.
using DistinctTimes = std::vector<double>;

/// Returns the frames of a given rate on which all times lie: each within half a unit of rounding
/// (or 1 % of a frame, which is noise) of its frame, and no two on the same frame. Nothing if there
/// are none. The unit is the greatest power of ten (s) of which all times are multiples.
std::optional<FrameTimes> frames_at_rate(const DistinctTimes& times, double frames_per_s);

/// Returns frames on which all times lie, at a rate such that the median step is one frame within
/// rounding: the step itself if all steps are its multiples, else the simplest rate that rounding
/// leaves possible, namely a usual one (24, 25, 30, 50, 60 ..., then those of NTSC), or else the
/// one with the fewest decimals. Missing frames do not matter. Nothing if times are irregular by
/// more than their rounding.
std::optional<FrameTimes> find_frames(const DistinctTimes& times);

/// As find_frames(), where the shortest step is one frame, since most frames are missing.
std::optional<FrameTimes> find_sparse_frames(const DistinctTimes& times);

/// The rate of times that vary around their frames, as those of a clock do: that of the mean of
/// the single steps, or a simpler one within its uncertainty. Expects at least two times.
double mean_rate(const DistinctTimes& times);

/// The median of the steps between at least two times.
double median_step(const DistinctTimes& times);

}  // namespace throng::metrics
