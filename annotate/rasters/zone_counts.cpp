#include "annotate/rasters/zone_counts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "annotate/people/coco.h"
#include "annotate/people/decimals.h"
#include "annotate/rasters/trajectories.h"
#include "base/error.h"
#include "base/geometry/polygon.h"
#include "spec/annotate/table_columns.h"

namespace throng::annotate {

using Eigen::Vector2d;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

bool holds_place(const CountZone& zone, const Vector2d& place) {
  return geometry::signed_distance_to(zone.corners, place) <= 0;
}

/// People who crossed a line between two frames.
struct Crossers {
  std::vector<std::int64_t> in;
  std::vector<std::int64_t> out;
};

/// When the way from `a` to `b` crosses the line, as a share of it; the side that it leads to.
struct Crossing {
  double share = 0;
  bool is_inward = false;
};

/// Standing on the line counts as being on its left, so that no way crosses it twice or not at all.
std::optional<Crossing> find_crossing(const CountLine& line, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = line.to - line.from;
  const double side_a = geometry::cross(along, Vector2d(a - line.from));
  const double side_b = geometry::cross(along, Vector2d(b - line.from));
  if ((side_a >= 0) == (side_b >= 0)) return std::nullopt;
  const double share = side_a / (side_a - side_b);
  const double place = (a + share * (b - a) - line.from).dot(along) / along.squaredNorm();
  if (place < 0 || place > 1) return std::nullopt;
  return Crossing{share, side_b >= 0};
}

/// Index of the first frame at or after a time; the number of frames after the last.
std::size_t frame_after(std::span<const double> times_s, double time_s) {
  return static_cast<std::size_t>(
      std::lower_bound(times_s.begin(), times_s.end(), time_s - world::kTimeSlackS) -
      times_s.begin());
}

/// Crossings of a line by frame; those up to the first frame's time are not counted.
std::vector<Crossers> find_crossers(const world::Trace& trace, const CountLine& line,
                                    std::span<const std::uint32_t> agents,
                                    std::span<const double> times_s, std::int64_t run_index) {
  std::vector<Crossers> found(times_s.size());
  for (std::size_t step = 1; step < trace.steps(); ++step) {
    if (trace.time_s[step] <= times_s.front() || trace.time_s[step - 1] > times_s.back()) continue;
    for (const std::uint32_t agent : agents) {
      if (!trace.present(step - 1, agent) || !trace.present(step, agent)) continue;
      const auto crossing =
          find_crossing(line, trace.position[trace.at(step - 1, agent)].cast<double>(),
                        trace.position[trace.at(step, agent)].cast<double>());
      if (!crossing) continue;
      const double time_s =
          trace.time_s[step - 1] + crossing->share * (trace.time_s[step] - trace.time_s[step - 1]);
      const std::size_t frame = frame_after(times_s, time_s);
      if (frame == 0 || frame >= times_s.size()) continue;
      (crossing->is_inward ? found[frame].in : found[frame].out)
          .push_back(track_id(run_index, agent));
    }
  }
  return found;
}

void append_row(std::string& text, std::size_t frame, double time_s, std::string_view kind,
                const std::string& id, const std::string& inside,
                const std::vector<std::int64_t>& in, const std::vector<std::int64_t>& out) {
  fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}\n", frame,
                 rounded(time_s, kTimeDecimals), kind, id, inside, in.size(), out.size(),
                 fmt::join(in, " "), fmt::join(out, " "));
}

json place_json(const Vector2d& place) { return {place.x(), place.y()}; }

}  // namespace

CountAreas count_areas(const world::Scenario& scenario, const CountAreas& of_job) {
  CountAreas areas;
  const Vector2d& low = scenario.ground.min;
  const Vector2d& high = scenario.ground.max;
  areas.zones.push_back({kGroundZone, {low, {high.x(), low.y()}, high, {low.x(), high.y()}}});
  for (const world::Exit& exit : scenario.exits) {
    const bool is_left_inside = geometry::cross(Vector2d(exit.to - exit.from), exit.outward) < 0;
    areas.lines.push_back(
        {exit.id, is_left_inside ? exit.from : exit.to, is_left_inside ? exit.to : exit.from});
  }
  areas.zones.insert(areas.zones.end(), of_job.zones.begin(), of_job.zones.end());
  areas.lines.insert(areas.lines.end(), of_job.lines.begin(), of_job.lines.end());
  return areas;
}

std::string counts_csv(const world::Trace& trace, const CountAreas& areas,
                       std::span<const double> times_s, std::int64_t run_index) {
  const Trajectories people = trajectories_at(trace, times_s);
  std::vector<std::vector<Crossers>> crossers;
  for (const CountLine& line : areas.lines) {
    crossers.push_back(find_crossers(trace, line, people.agents, times_s, run_index));
  }
  std::vector<std::set<std::int64_t>> before(areas.zones.size());
  std::string text = fmt::format("{}\n", kCountColumns);
  for (std::size_t frame = 0; frame < times_s.size(); ++frame) {
    for (std::size_t i = 0; i < areas.zones.size(); ++i) {
      std::set<std::int64_t> now;
      for (std::size_t person = 0; person < people.agents.size(); ++person) {
        const float* value =
            &people.values[(frame * people.agents.size() + person) * kTrajectoryValues];
        if (std::isnan(value[0])) continue;
        const Vector2d place(static_cast<double>(value[0]), static_cast<double>(value[1]));
        if (holds_place(areas.zones[i], place)) {
          now.insert(track_id(run_index, people.agents[person]));
        }
      }
      std::vector<std::int64_t> entered;
      std::vector<std::int64_t> left;
      std::set_difference(now.begin(), now.end(), before[i].begin(), before[i].end(),
                          std::back_inserter(entered));
      std::set_difference(before[i].begin(), before[i].end(), now.begin(), now.end(),
                          std::back_inserter(left));
      append_row(text, frame, times_s[frame], "zone", areas.zones[i].id, std::to_string(now.size()),
                 entered, left);
      before[i] = std::move(now);
    }
    for (std::size_t i = 0; i < areas.lines.size(); ++i) {
      const Crossers& here = crossers[i][frame];
      append_row(text, frame, times_s[frame], "line", areas.lines[i].id, "", here.in, here.out);
    }
  }
  return text;
}

std::string counts_json(const CountAreas& areas) {
  ordered_json zones = ordered_json::array();
  for (const CountZone& zone : areas.zones) {
    json corners = json::array();
    for (const Vector2d& corner : zone.corners) corners.push_back(place_json(corner));
    zones.push_back({{"id", zone.id}, {"corners", corners}});
  }
  ordered_json lines = ordered_json::array();
  for (const CountLine& line : areas.lines) {
    lines.push_back(
        {{"id", line.id}, {"start", place_json(line.from)}, {"end", place_json(line.to)}});
  }
  return ordered_json{{"zones", std::move(zones)}, {"lines", std::move(lines)}}.dump() + "\n";
}

std::string visible_in_zones(const FrameLabels& labels, const std::vector<CountZone>& zones) {
  ordered_json counts = ordered_json::array();
  for (const CountZone& zone : zones) {
    const auto visible =
        std::count_if(labels.people.begin(), labels.people.end(), [&](const PersonLabel& label) {
          return holds_place(zone, label.person.position.head<2>());
        });
    counts.push_back({{"id", zone.id}, {"visible", visible}});
  }
  return counts.dump();
}

}  // namespace throng::annotate
