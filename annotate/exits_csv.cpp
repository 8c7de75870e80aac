#include "annotate/exits_csv.h"

#include <fmt/format.h>

#include <iterator>

#include "annotate/exits/exit_view.h"
#include "annotate/people/decimals.h"
#include "base/error.h"
#include "spec/annotate/table_columns.h"

namespace throng::annotate {

namespace {

// Quoted where a comma, quote or line break would break the row (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted.push_back('"');
    quoted.push_back(c);
  }
  quoted.push_back('"');
  return quoted;
}

}  // namespace

std::string exits_csv(const std::vector<metrics::ExitSeries>& exits,
                      std::span<const double> step_times_s, std::span<const FrameTime> frames) {
  std::string text = fmt::format("{}\n", kExitColumns);
  if (step_times_s.empty()) return text;
  for (const FrameTime& frame : frames) {
    const std::size_t step = step_at(step_times_s, frame.time_s);
    for (const metrics::ExitSeries& exit : exits) {
      check(exit.samples.size() == step_times_s.size(), "an exit has a sample per step");
      const metrics::ExitSample& sample = exit.samples[step];
      fmt::format_to(
          std::back_inserter(text),
          "{},{},{},{},{:.4f},{:.4f},{:.4f},{},{},{:.2f},{:.2f},{},{:.4f},"
          "{:.4f},{:.3f},{},{},{:.2f},{:.2f},{:.5f},{}\n",
          frame.frame_index, rounded(frame.time_s, kTimeDecimals), csv_field(exit.exit_id),
          sample.in_zone, sample.density_per_m2, sample.normalized_density,
          sample.approach_speed_mps, sample.crossed_out, sample.crossed_in, sample.flow_per_s,
          sample.since_crossing_s, metrics::to_string(sample.state), sample.clogging_index,
          sample.voronoi_density_per_m2, sample.specific_flow_per_ms, sample.demand ? 1 : 0,
          sample.queue, sample.queue_length_m, sample.predicted_wait_s, sample.pressure_per_s2,
          metrics::to_string(sample.state_offline));
    }
  }
  return text;
}

}  // namespace throng::annotate
