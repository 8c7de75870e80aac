// RiMEA 12: two bottlenecks in series, and what the length and width of one do.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/compute/quantile.h"
#include "validation/criteria.h"
#include "validation/flow.h"
#include "validation/run.h"
#include "validation/suite.h"

namespace throng::validation {

namespace {

/// Two rooms of 10 m x 10 m in a row, from x = -10 on; people start in the first one. Each has a
/// way out of this width and length in the middle of its right wall.
struct Series {
  double width_m = 1;
  double length_m = 0.2;
  bool second_room = false;
  double goal_m = 1;  ///< from the last way out to the goal
  std::size_t people = 150;
};

struct Outcome {
  std::optional<double> end_s;
  double first_flow = 0;  ///< people per second through the first way out, 10th to 80th percentile
  double last_flow = 0;   ///< through the last one
  std::size_t first_queue = 0;  ///< max slower than 0.3 m/s in the first room, after 10 s
  std::size_t last_queue = 0;   ///< in the second room
};

void add_room_walls(double right_x, const Series& series, TestScene& scene) {
  const double half = series.width_m / 2;
  const double end = right_x + series.length_m;
  scene.walls.push_back(box(right_x, -6, end, -half));
  scene.walls.push_back(box(right_x, half, end, 6));
  scene.walls.push_back(box(right_x - 10, -6, right_x, -5));
  scene.walls.push_back(box(right_x - 10, 5, right_x, 6));
}

Outcome walk(const Tested& tested, const Series& series, std::uint64_t seed) {
  TestScene scene;
  scene.walls = {box(-11, -6, -10, 6)};
  add_room_walls(0, series, scene);
  double last_x = 0;
  if (series.second_room) {
    last_x = series.length_m + 10;
    add_room_walls(last_x, series, scene);
  }
  Group group;
  group.places = lattice({-9.5, -4.75}, {-0.5, 4.75}, series.people);
  group.aside_m = 0.1;
  scene.groups = {group};
  const double goal = last_x + series.length_m + series.goal_m;
  scene.behavior.goal_box(0, goal, -0.5, goal + 3, 0.5).walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, seed);
  std::vector<float> before(crowd.agent_count());
  std::vector<double> first_s;
  std::vector<double> last_s;
  Outcome outcome;
  for (std::size_t i = 0; i < before.size(); ++i) before[i] = crowd.positions()[i].x();
  outcome.end_s = until_all_left(crowd, 1200, [&](const crowd::Simulation& now) {
    std::size_t first_queue = 0;
    std::size_t last_queue = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const float x = now.positions()[i].x();
      if (before[i] < 0 && x >= 0) first_s.push_back(now.time_s());
      if (before[i] < last_x && x >= last_x) last_s.push_back(now.time_s());
      before[i] = std::max(before[i], x);
      constexpr float kSlow = 0.3F;  // m/s
      if (now.present()[i] == 0 || now.velocities()[i].norm() >= kSlow) continue;
      if (x < 0) ++first_queue;
      if (x > series.length_m && x < last_x) ++last_queue;
    }
    if (now.time_s() < 10) return;
    outcome.first_queue = std::max(outcome.first_queue, first_queue);
    outcome.last_queue = std::max(outcome.last_queue, last_queue);
  });
  outcome.first_flow = central_rate(first_s, series.people);
  outcome.last_flow = central_rate(last_s, series.people);
  return outcome;
}

std::size_t count_people(Effort effort) { return effort == Effort::full ? 150 : 50; }
std::size_t count_runs(Effort effort) { return effort == Effort::full ? 7 : 3; }

/// Median of the times until all are out; infinite where most runs jam.
double median_end(const Tested& tested, const Series& series, Effort effort) {
  std::vector<double> ends;
  ends.reserve(count_runs(effort));
  for (std::uint64_t seed = 1; seed <= count_runs(effort); ++seed) {
    ends.push_back(walk(tested, series, seed).end_s.value_or(INFINITY));
  }
  return median(ends);
}

Verdict near_goal(const Tested& tested, Effort effort) {
  Series series;
  series.people = count_people(effort);
  series.goal_m = 1;
  const double near = median_end(tested, series, effort);
  series.goal_m = 5;
  const double far = median_end(tested, series, effort);
  return criteria::ordered_times(near, far, false);
}

Verdict long_bottleneck(const Tested& tested, Effort) {
  constexpr Effort kAlways = Effort::full;  // fewer runs do not tell 2 % from chance
  Series series;
  series.people = count_people(kAlways);
  series.length_m = 0.2;
  series.goal_m = 5.8;
  const double shorter = median_end(tested, series, kAlways);
  series.length_m = 5;
  series.goal_m = 1;
  const double longer = median_end(tested, series, kAlways);
  return criteria::ordered_times(shorter, longer, true);
}

Verdict two_bottlenecks(const Tested& tested, Effort effort) {
  Series series;
  series.people = count_people(effort);
  series.second_room = true;
  std::vector<double> differences;
  std::vector<double> first;
  std::vector<double> last;
  for (std::uint64_t seed = 1; seed <= count_runs(effort); ++seed) {
    const Outcome outcome = walk(tested, series, seed);
    differences.push_back(outcome.last_flow > 0 ? outcome.first_flow - outcome.last_flow
                                                : -INFINITY);
    first.push_back(static_cast<double>(outcome.first_queue));
    last.push_back(static_cast<double>(outcome.last_queue));
  }
  return criteria::series_flow({median(differences), median(first), median(last)});
}

Verdict widths(const Tested& tested, Effort effort) {
  std::vector<double> flows;
  for (const double width : {0.8, 1.0, 1.2}) {
    std::vector<double> of_seeds;
    of_seeds.reserve(count_runs(effort));
    for (std::uint64_t seed = 1; seed <= count_runs(effort); ++seed) {
      of_seeds.push_back(width * specific_flow(tested, {width, 0.2, count_people(effort)}, seed));
    }
    flows.push_back(median(of_seeds));
  }
  return criteria::growing_flows(flows);
}

}  // namespace

std::vector<Test> rimea_bottleneck_tests() {
  return {
      {"rimea_12a", "RiMEA 12 a",
       "room of 10 m x 10 m, 150 people, door of 1 m; goal 1 m or 5 m behind it; median of 7 runs",
       "with the near goal not slower", near_goal},
      {"rimea_12b", "RiMEA 12 b",
       "the same; the way out is 0.2 m or 5 m long, the goal as far away",
       "through the long one slower", long_bottleneck},
      {"rimea_12c", "RiMEA 12 c", "the same with a second room and door behind the first; medians",
       "flow at the first less that at the last at least -0.05 /s; the longer queue is in the "
       "first room",
       two_bottlenecks},
      {"rimea_12d", "RiMEA 12 d", "the same room, doors of 0.8, 1.0 and 1.2 m; medians",
       "flow grows with width", widths},
  };
}

}  // namespace throng::validation
