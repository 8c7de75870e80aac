#include "metrics/trajectories/timed_tracks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "metrics/trajectories/frame_times.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kMaxGapS = 1;
constexpr double kMaxTimeS = 1e6;

/// The times of any people in order, without repetitions.
DistinctTimes distinct_times(const std::vector<Track>& tracks) {
  constexpr double kSameTimeS = 1e-4;
  DistinctTimes times;
  for (const Track& track : tracks) {
    for (const auto& [time, place] : track) times.push_back(time);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end(),
                          [](double a, double b) { return b - a <= kSameTimeS; }),
              times.end());
  return times;
}

/// Whether most steps between times are whole multiples of a step: events of a simulation are not.
bool is_regular(const DistinctTimes& times, double step_s) {
  constexpr double kSlack = 0.1;  // of a step
  constexpr double kMinRegularShare = 0.6;
  std::size_t regular = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double steps = (times[i] - times[i - 1]) / step_s;
    if (std::abs(steps - std::round(steps)) <= kSlack && std::round(steps) > 0) ++regular;
  }
  return static_cast<double>(regular) >= kMinRegularShare * static_cast<double>(times.size() - 1);
}

/// Puts times on their frames if they have any, and returns the rate. Notes that there are none.
double count_by_frames(std::vector<Track>& tracks, std::optional<double> given,
                       const std::string& name, std::vector<Problem>& notes) {
  constexpr std::size_t kTooFewToJudge = 5;
  const DistinctTimes times = distinct_times(tracks);
  if (times.size() < 2) {
    if (given) return *given;
    throw InputError(
        {name, "", "people at one time only", "times of at least two frames, or --frame-rate"});
  }
  auto frames = given ? frames_at_rate(times, *given) : find_frames(times);
  if (!frames && given) return *given;
  if (!frames) {
    if (times.size() < kTooFewToJudge || is_regular(times, median_step(times))) {
      const double rate = mean_rate(times);
      notes.push_back(
          {"", "",
           fmt::format("times that vary by more than their rounding: positions are interpolated at "
                       "{:g} frames per second",
                       rate),
           ""});
      return rate;
    }
    frames = find_sparse_frames(times);
  }
  if (!frames) {
    throw InputError({name, "", "times without a regular step, as of events",
                      kFrameRateExpected + std::string(", to interpolate to")});
  }
  for (Track& track : tracks) {
    Track counted;
    for (const auto& [time, place] : track) {
      counted[std::round(time * frames->frames_per_s - frames->phase) / frames->frames_per_s] =
          place;
    }
    track = std::move(counted);
  }
  return frames->frames_per_s;
}

std::map<std::int64_t, Vector2d> on_frames(const Track& track, double frames_per_s,
                                           double max_gap_s) {
  constexpr double kSlack = 1e-3;  // of a frame
  std::map<std::int64_t, Vector2d> places;
  for (auto now = track.begin(); now != track.end(); ++now) {
    const double at = now->first * frames_per_s;
    if (std::abs(at - std::round(at)) < kSlack) places[std::llround(at)] = now->second;
    const auto next = std::next(now);
    if (next == track.end()) break;
    const double step_s = next->first - now->first;
    if (step_s > std::max(max_gap_s, 1.5 / frames_per_s)) continue;
    const double until = next->first * frames_per_s - kSlack;
    for (double frame = std::floor(at + kSlack) + 1; frame < until; ++frame) {
      const double share = (frame - at) / (step_s * frames_per_s);
      places[std::llround(frame)] = (1 - share) * now->second + share * next->second;
    }
  }
  return places;
}

}  // namespace

void count_from_first(std::vector<Track>& tracks) {
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const Track& track : tracks) {
    if (track.empty()) continue;
    first = std::min(first, track.begin()->first);
    last = std::max(last, track.rbegin()->first);
  }
  if (!(last > kMaxTimeS) || first <= 0) return;
  // Unix times of this century have ten digits in seconds.
  constexpr double kMaxSeconds = 1e11;
  double unit_s = 1;
  for (double most = kMaxSeconds; last > most && unit_s > 1e-9; most *= 1e3) unit_s *= 1e-3;
  for (Track& track : tracks) {
    Track counted;
    for (const auto& [time, place] : track) counted[(time - first) * unit_s] = place;
    track = std::move(counted);
  }
}

Recorded put_on_frames(TimedPeople people, std::optional<double> frames_per_s,
                       const std::string& name) {
  count_from_first(people.tracks);
  for (const Track& track : people.tracks) {
    for (const auto* end : {&*track.begin(), &*track.rbegin()}) {
      if (std::abs(end->first) <= kMaxTimeS) continue;
      throw InputError(
          {name, "", fmt::format("a time of {:g} s", end->first), "times within 1e6 s"});
    }
  }
  Recorded recorded;
  recorded.frames_per_s = count_by_frames(people.tracks, frames_per_s, name, recorded.notes);
  double frames = 0;
  for (const Track& track : people.tracks) {
    frames += (track.rbegin()->first - track.begin()->first) * recorded.frames_per_s;
  }
  constexpr double kMaxInterpolated = 4e7;  // of all people
  if (frames > kMaxInterpolated) {
    throw InputError({name, "", fmt::format("{:.3g} places of people in frames", frames),
                      fmt::format("at most {:g}", kMaxInterpolated)});
  }
  const double max_gap_s = people.spans_gaps ? std::numeric_limits<double>::infinity() : kMaxGapS;
  for (std::size_t i = 0; i < people.tracks.size(); ++i) {
    auto places = on_frames(people.tracks[i], recorded.frames_per_s, max_gap_s);
    if (!places.empty()) recorded.places[people.ids[i]] = std::move(places);
  }
  return recorded;
}

}  // namespace throng::metrics
