#include "validation/experiments/walks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/compute/quantile.h"
#include "base/geometry/polygon.h"
#include "validation/scene.h"

namespace throng::validation {

using Eigen::Vector2d;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The goal that a path approaches most: the one that it reaches, by the triangle inequality, and
/// the right one, too, of somebody whom the recording loses on the way.
std::size_t approached_goal(const Walk& walk, const std::vector<Eigen::AlignedBox2d>& goals) {
  const auto left_m = [&](const Eigen::AlignedBox2d& goal) {
    return goal.exteriorDistance(walk.places.back()) - goal.exteriorDistance(walk.places.front());
  };
  const auto nearest =
      std::min_element(goals.begin(), goals.end(),
                       [&](const auto& a, const auto& b) { return left_m(a) < left_m(b); });
  return static_cast<std::size_t>(nearest - goals.begin());
}

/// The time of the first crossing of the line.
std::optional<double> passage_s(const Walk& walk, const CountingLine& line, double dt_s) {
  const Vector2d along = (line.to - line.from).normalized();
  const auto side = [&](const Vector2d& p) { return geometry::cross(along, p - line.from); };
  for (std::size_t i = 1; i < walk.places.size(); ++i) {
    const double before = side(walk.places[i - 1]);
    const double after = side(walk.places[i]);
    if ((before < 0) == (after < 0) || before == after) continue;
    const double share = before / (before - after);
    const Vector2d crossing = walk.places[i - 1] + share * (walk.places[i] - walk.places[i - 1]);
    constexpr double kBesideM = 0.5;  // people lean over the ends of the line
    const double at = along.dot(crossing - line.from);
    if (at < -kBesideM || at > line.length_m() + kBesideM) continue;
    return dt_s * (static_cast<double>(walk.first_step + i - 1) + share);
  }
  return std::nullopt;
}

std::vector<double> passages_s(const Walks& walks, const CountingLine& line,
                               std::optional<std::size_t> stream = {}) {
  std::vector<double> times;
  for (const Walk& walk : walks.people) {
    if (stream && walk.stream != *stream) continue;
    if (const auto time_s = passage_s(walk, line, walks.dt_s)) times.push_back(*time_s);
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// The time at which a share of `people` has passed.
double time_of_share(const std::vector<double>& passages, std::size_t people, double share) {
  constexpr double kRounding = 1e-9;  // 0.7 * 10 exceeds 7
  const auto rank =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(people) - kRounding));
  return rank == 0 || rank > passages.size() ? kNever : passages[rank - 1];
}

std::size_t count_within(const std::vector<double>& sorted, const TimeRange& range) {
  return static_cast<std::size_t>(std::upper_bound(sorted.begin(), sorted.end(), range.until_s) -
                                  std::lower_bound(sorted.begin(), sorted.end(), range.from_s));
}

/// The band index: 1 if each band of the width of a person has people of one direction only.
double band_index(const Walks& walks, const Recording& recording, const TimeRange& range) {
  constexpr double kBandM = 0.5;
  const Vector2d across = (recording.line.to - recording.line.from).normalized();
  const auto bands = static_cast<std::size_t>(std::ceil(recording.line.length_m() / kBandM));
  const auto first = static_cast<std::size_t>(range.from_s / walks.dt_s);
  const auto last = static_cast<std::size_t>(range.until_s / walks.dt_s);
  const std::size_t every = std::max<std::size_t>(1, static_cast<std::size_t>(0.5 / walks.dt_s));
  double one_way = 0;
  double all = 0;
  for (std::size_t step = first; step <= last; step += every) {
    std::vector<std::array<int, 2>> counts(bands);
    for (const Walk& walk : walks.people) {
      if (step < walk.first_step || step - walk.first_step >= walk.places.size()) continue;
      const Vector2d& place = walk.places[step - walk.first_step];
      if (!recording.area.contains(place)) continue;
      const double at = across.dot(place - recording.line.from) / kBandM;
      const auto band =
          static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(bands) - 1));
      ++counts[band][std::min<std::size_t>(walk.stream, 1)];
    }
    for (const auto& [there, back] : counts) {
      one_way += std::abs(there - back);
      all += there + back;
    }
  }
  return all > 0 ? one_way / all : 0;
}

/// Whether the line lies between the goals of two streams.
bool walk_both_ways(const Recording& recording) {
  if (recording.goals.size() != 2) return false;
  const CountingLine& line = recording.line;
  const auto side = [&](const Eigen::AlignedBox2d& goal) {
    const Vector2d center = goal.center();
    return geometry::cross(line.to - line.from, center - line.from);
  };
  return side(recording.goals[0]) * side(recording.goals[1]) < 0;
}

}  // namespace

Walks recorded_walks(const world::Trace& trace, const std::vector<Eigen::AlignedBox2d>& goals) {
  constexpr double kBridgedS = 1;
  Walks walks{trace.header.dt_s, {}};
  const auto bridged = static_cast<std::size_t>(kBridgedS / walks.dt_s);
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    Walk* walk = nullptr;
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      if (!trace.present(step, agent)) continue;
      const Vector2d place = trace.position[trace.at(step, agent)].cast<double>();
      const std::size_t next = walk == nullptr ? 0 : walk->first_step + walk->places.size();
      const std::size_t missing = step - next;
      if (walk == nullptr || missing > bridged) {
        walk = &walks.people.emplace_back(Walk{step, 0, {}});
      } else {
        const Vector2d from = walk->places.back();
        for (std::size_t i = 1; i <= missing; ++i) {
          const double share = static_cast<double>(i) / static_cast<double>(missing + 1);
          walk->places.emplace_back(from + share * (place - from));
        }
      }
      walk->places.push_back(place);
    }
  }
  if (goals.empty()) return walks;
  for (Walk& walk : walks.people) walk.stream = approached_goal(walk, goals);
  return walks;
}

void begin_on_ground(Walks& walks, const Recording& recording) {
  const auto is_ground = [&](const Vector2d& place) {
    return geometry::signed_distance_to(recording.walkable, place) <= 0 &&
           std::none_of(recording.obstacles.begin(), recording.obstacles.end(),
                        [&](const Polygon& obstacle) {
                          return geometry::signed_distance_to(obstacle, place) <= 0;
                        });
  };
  for (Walk& walk : walks.people) {
    const auto first = std::find_if(walk.places.begin(), walk.places.end(), is_ground);
    walk.first_step += static_cast<std::size_t>(first - walk.places.begin());
    walk.places.erase(walk.places.begin(), first);
  }
  std::erase_if(walks.people, [](const Walk& walk) { return walk.places.empty(); });
}

double duration_s(const Walks& walks) {
  std::size_t steps = 1;
  for (const Walk& walk : walks.people) {
    steps = std::max(steps, walk.first_step + walk.places.size());
  }
  return walks.dt_s * static_cast<double>(steps - 1);
}

TimeRange steady_range(const Walks& recorded, const Recording& recording) {
  if (recording.steady) return *recording.steady;
  const std::vector<double> times = passages_s(recorded, recording.line);
  if (times.size() < 2) return {0, duration_s(recorded)};
  return {quantile_of_sorted(times, 0.2), quantile_of_sorted(times, 0.8)};
}

AreaMeans means_in_area(const Walks& walks, const Eigen::AlignedBox2d& area,
                        const TimeRange& range) {
  constexpr double kRounding = 1e-6;
  const double first_step = std::ceil(range.from_s / walks.dt_s - kRounding);
  const double last_step = std::floor(range.until_s / walks.dt_s + kRounding);
  double people_steps = 0;
  double way_m = 0;
  double stayed_s = 0;
  for (const Walk& walk : walks.people) {
    std::optional<std::size_t> entered;
    for (std::size_t i = 0; i < walk.places.size(); ++i) {
      const auto step = static_cast<double>(walk.first_step + i);
      const bool is_there =
          step >= first_step && step <= last_step && area.contains(walk.places[i]);
      if (is_there) {
        ++people_steps;
        if (!entered) entered = i;
      }
      if (!entered || (is_there && i + 1 < walk.places.size())) continue;
      const std::size_t last = is_there ? i : i - 1;
      way_m += (walk.places[last] - walk.places[*entered]).norm();
      stayed_s += walks.dt_s * static_cast<double>(last - *entered);
      entered.reset();
    }
  }
  const double steps = std::max(1.0, last_step - first_step + 1);
  return {people_steps / steps / area.volume(), stayed_s > 0 ? way_m / stayed_s : std::nan("")};
}

Measures measure(const Walks& walks, const Recording& recording, const TimeRange& steady) {
  Measures measures;
  measures.passages_s = passages_s(walks, recording.line);
  measures.people = walks.people.size();
  const auto add = [&](std::string name, std::string unit, double value) {
    measures.quantities.push_back({std::move(name), std::move(unit), value});
  };
  // Between the same shares of the people, since a slower crowd is in its steady state longer.
  for (std::size_t stream = 0; stream < recording.goals.size(); ++stream) {
    const std::vector<double> times = passages_s(walks, recording.line, stream);
    const auto members =
        static_cast<std::size_t>(std::count_if(walks.people.begin(), walks.people.end(),
                                               [&](const Walk& w) { return w.stream == stream; }));
    const double from_s = time_of_share(times, members, 0.2);
    const double until_s = time_of_share(times, members, 0.8);
    const auto passed = static_cast<double>(count_within(times, {from_s, until_s})) - 1;
    const bool all = std::isfinite(until_s) && until_s > from_s;
    const double flow = all ? passed / (until_s - from_s) / recording.line.length_m() : 0;
    add(recording.goals.size() == 1 ? "flow" : "flow " + std::to_string(stream + 1), "1/(m s)",
        members < 2 ? std::nan("") : flow);
  }
  const AreaMeans means = means_in_area(walks, recording.area, steady);
  add("density", "1/m²", means.density);
  add("speed", "m/s", means.speed_mps);
  add("T90", "s", time_of_share(measures.passages_s, measures.people, 0.9));
  std::vector<double> gaps;
  for (std::size_t i = 1; i < measures.passages_s.size(); ++i) {
    gaps.push_back(measures.passages_s[i] - measures.passages_s[i - 1]);
  }
  add("time gap, median", "s", quantile(gaps, 0.5));
  add("time gap, 90 %", "s", quantile(gaps, 0.9));
  if (walk_both_ways(recording)) add("band index", "", band_index(walks, recording, steady));
  return measures;
}

double curve_difference(const std::vector<double>& recorded_s, const std::vector<double>& model_s) {
  if (recorded_s.empty()) return 0;
  double worst = 0;
  const auto passed = [](const std::vector<double>& times, double time_s) {
    return static_cast<double>(std::upper_bound(times.begin(), times.end(), time_s) -
                               times.begin());
  };
  for (const std::vector<double>* times : {&recorded_s, &model_s}) {
    for (const double time_s : *times) {
      worst = std::max(worst, std::abs(passed(recorded_s, time_s) - passed(model_s, time_s)));
    }
  }
  return worst / static_cast<double>(recorded_s.size());
}

}  // namespace throng::validation
