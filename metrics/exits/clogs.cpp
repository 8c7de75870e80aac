#include "metrics/exits/clogs.h"

#include <algorithm>

#include "base/error.h"
#include "world/trace.h"

namespace throng::metrics {

namespace {

// The step of the last passage before the clog, or the first one with demand since.
std::size_t find_clog_onset(const std::vector<ExitSample>& samples,
                            const std::vector<double>& time_s, std::size_t clogged) {
  const double last_s = time_s[clogged] - samples[clogged].since_crossing_s;
  std::size_t onset = clogged;
  while (onset > 0 && samples[onset - 1].demand &&
         time_s[onset - 1] >= last_s - world::kTimeSlackS) {
    --onset;
  }
  return onset;
}

// The step of the next passage, or the first one without demand or with the door closed.
std::size_t find_clog_end(const std::vector<ExitSample>& samples, std::size_t from) {
  std::size_t end = from;
  while (end < samples.size() && samples[end].demand && samples[end].state != ExitState::closed &&
         samples[end].since_crossing_s > world::kTimeSlackS) {
    ++end;
  }
  return end;
}

}  // namespace

void find_clogs(ExitSeries& series, const std::vector<double>& time_s) {
  check(series.samples.size() == time_s.size(), "an exit has a sample per step");
  std::vector<ExitSample>& samples = series.samples;
  for (ExitSample& sample : samples) sample.state_offline = sample.state;
  std::size_t step = 0;
  std::size_t last_end = 0;
  while (step < samples.size()) {
    if (samples[step].state != ExitState::clogged) {
      ++step;
      continue;
    }
    const std::size_t onset = find_clog_onset(samples, time_s, step);
    // A short relief without a passage does not make two clogs out of one gap.
    const bool same_gap = !series.clogs.empty() && onset < last_end;
    if (!same_gap) {
      series.clogs.emplace_back();
      series.clogs.back().from_s = time_s[onset];
      series.clogs.back().people_at_onset = samples[onset].in_zone;
    }
    ClogEvent& clog = series.clogs.back();
    std::size_t end = step;
    while (end < samples.size() && samples[end].state == ExitState::clogged) ++end;
    // A person who stops pressing has not passed yet.
    end = std::max(end, find_clog_end(samples, end));
    clog.until_s = end < samples.size() ? time_s[end] : time_s.back();
    clog.ended = end < samples.size();
    for (std::size_t i = onset; i < end; ++i) {
      samples[i].state_offline = ExitState::clogged;
      clog.max_normalized_density =
          std::max(clog.max_normalized_density, samples[i].normalized_density);
      clog.max_pressure_per_s2 = std::max(clog.max_pressure_per_s2, samples[i].pressure_per_s2);
    }
    last_end = end;
    step = end;
  }
}

}  // namespace throng::metrics
