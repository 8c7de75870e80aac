#include "validation/criteria.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace throng::validation::criteria {

namespace {

constexpr double kMaxStuck = 0.02;  // share of people who get nowhere

double compute_mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The values with two decimals, separated by spaces or something else.
std::string listed(const std::vector<double>& values, const char* separator = " ") {
  std::string text;
  for (const double value : values) {
    text += fmt::format("{}{:.2f}", text.empty() ? "" : separator, value);
  }
  return text;
}

std::string in_s(double time_s) {
  return std::isinf(time_s) ? "jams" : fmt::format("{:.1f} s", time_s);
}

}  // namespace

Verdict corridor_time(double time_s, bool inside) {
  return {time_s >= 26 && time_s <= 34 && inside,
          fmt::format("{:.1f} s{}", time_s, inside ? "" : ", left the corridor")};
}

Verdict corridor_speed(double time_s) {
  const double speed = 40 / time_s;
  return {std::abs(speed - 1) <= 0.05, fmt::format("{:.3f} m/s", speed)};
}

Verdict falling_speeds(const std::vector<double>& speeds_mps) {
  const bool falls = std::adjacent_find(speeds_mps.begin(), speeds_mps.end(),
                                        std::less_equal<>()) == speeds_mps.end();
  return {falls, listed(speeds_mps) + " m/s"};
}

Verdict start_times(const std::vector<double>& started_s, bool all_out) {
  double worst = 0;
  for (std::size_t i = 0; i < started_s.size(); ++i) {
    worst = std::max(worst, std::abs(started_s[i] - 10.0 * static_cast<double>(i + 1)));
  }
  return {all_out && worst <= 0.5,
          fmt::format("{:.1f} s off{}", worst, all_out ? "" : ", not all out")};
}

Verdict corner_walk(std::optional<double> end_s, long outside, double max_s) {
  const std::string time = end_s ? fmt::format("{:.1f} s", *end_s) : "jams";
  return {outside == 0 && end_s && *end_s < max_s, fmt::format("{}, {} outside", time, outside)};
}

Verdict age_speeds(const std::vector<AgeSpeeds>& groups) {
  constexpr double kTolerance = 0.03;  // m/s
  std::string values;
  bool passed = true;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const AgeSpeeds& group = groups[i];
    const auto [slowest, fastest] =
        std::minmax_element(group.measured_mps.begin(), group.measured_mps.end());
    passed =
        passed && *slowest >= group.min_mps - kTolerance && *fastest <= group.max_mps + kTolerance;
    if (i >= 2) {
      passed =
          passed && compute_mean(groups[i - 1].measured_mps) > compute_mean(group.measured_mps);
    }
    values += fmt::format("{}{:.2f}-{:.2f}", i == 0 ? "" : ", ", *slowest, *fastest);
  }
  return {passed, values + " m/s"};
}

Verdict exit_ratio(std::optional<double> four_exits_s, std::optional<double> two_exits_s) {
  if (!four_exits_s || !two_exits_s) return {false, "jams"};
  const double ratio = *two_exits_s / *four_exits_s;
  return {ratio >= 1.6 && ratio <= 2.4,
          fmt::format("{:.2f} ({:.0f} s, {:.0f} s)", ratio, *four_exits_s, *two_exits_s)};
}

Verdict exit_assignment(const std::array<int, 2>& used, const std::array<int, 2>& assigned) {
  return {used == assigned,
          fmt::format("{} of {}, {} of {}", used[0], assigned[0], used[1], assigned[1])};
}

Verdict exit_shares(const std::array<int, 2>& used, int people) {
  const int out = used[0] + used[1];
  const double percent = 100.0 * used[0] / std::max(1, out);
  return {out == people && percent > 50 && used[1] > 0,
          fmt::format("{:.0f} % the nearer, {} of {} out", percent, out, people)};
}

Verdict ordered_times(double first_s, double second_s, bool strict) {
  const bool ordered = strict ? first_s < second_s : first_s <= second_s;
  return {ordered && !std::isinf(first_s), in_s(first_s) + ", " + in_s(second_s)};
}

Verdict series_flow(const SeriesFlow& medians) {
  if (std::isinf(medians.difference_per_s)) return {false, "jams"};
  return {medians.difference_per_s >= -0.05 && medians.first_queue > medians.last_queue,
          fmt::format("{:+.2f} /s, queues {:.0f}, {:.0f}", medians.difference_per_s,
                      medians.first_queue, medians.last_queue)};
}

Verdict growing_flows(const std::vector<double>& flows_per_s) {
  const bool grows = std::adjacent_find(flows_per_s.begin(), flows_per_s.end(),
                                        std::greater_equal<>()) == flows_per_s.end();
  return {flows_per_s.front() > 0 && grows, listed(flows_per_s, ", ") + " /s"};
}

Verdict corner_times(std::optional<double> short_s, std::optional<double> corner_s,
                     std::optional<double> long_s) {
  if (!short_s || !corner_s || !long_s) return {false, "jams"};
  return {*short_s <= *corner_s && *corner_s <= *long_s,
          fmt::format("{:.0f}, {:.0f}, {:.0f} s", *short_s, *corner_s, *long_s)};
}

Verdict single_file_speeds(const std::vector<FileSpeeds>& files) {
  constexpr double kFree = 1.34;  // m/s
  constexpr double kSame = 0.02;  // m/s
  std::size_t near = 0;
  bool ordered = true;
  std::vector<double> speeds;
  for (const FileSpeeds& file : files) {
    const double speed = file.at_134_mps;
    speeds.push_back(speed);
    ordered = ordered && file.at_080_mps < speed + kSame && speed < file.at_160_mps + kSame;
    const double headway = 26 / static_cast<double>(file.people);
    const double observed = std::clamp((headway - 0.36) / 1.06, 0.0, kFree);
    if (std::abs(speed - observed) <= 0.25) ++near;
  }
  return {4 * near >= 3 * files.size() && ordered,
          fmt::format("{} m/s, {} of {} near{}", listed(speeds), near, files.size(),
                      ordered ? "" : ", not ordered by free speed")};
}

Verdict speed_distribution(const std::vector<double>& speeds_mps) {
  const double mean = compute_mean(speeds_mps);
  double variance = 0;
  for (const double speed : speeds_mps) variance += (speed - mean) * (speed - mean);
  const double deviation = std::sqrt(variance / static_cast<double>(speeds_mps.size() - 1));
  // Three standard errors of 100 samples.
  return {std::abs(mean - 1.2) <= 0.06 && std::abs(deviation - 0.2) <= 0.043,
          fmt::format("{:.2f} ± {:.2f} m/s", mean, deviation)};
}

Verdict falling_counts(const std::vector<int>& across) {
  std::string values;
  for (const int count : across) {
    values += fmt::format("{}{}", values.empty() ? "" : ", ", count);
  }
  const bool grows =
      std::adjacent_find(across.begin(), across.end(), std::less<>()) != across.end();
  return {!grows, values + " across"};
}

Verdict closed_exit(int early, int late, bool all_out) {
  return {all_out && early > 0 && late == 0, fmt::format("{} before, {} after{}", early, late,
                                                         all_out ? ", all out" : ", not all out")};
}

Verdict congested_entrance(double door_density, double corridor_density, bool all_out) {
  return {
      all_out && door_density > corridor_density,
      fmt::format("{:.1f}, {:.1f} /m²{}", door_density, corridor_density, all_out ? "" : ", jams")};
}

Verdict weidmann_diagram(const std::vector<DensitySpeed>& measured) {
  double worst = 0;
  for (const DensitySpeed& each : measured) {
    const double off = each.speed_mps - weidmann_speed_mps(each.density);
    if (std::abs(off) > std::abs(worst)) worst = off;
  }
  return {std::abs(worst) <= 0.2, fmt::format("{:+.2f} m/s at most", worst)};
}

Verdict specific_flows(const std::vector<double>& flows) {
  const bool inside = std::all_of(flows.begin(), flows.end(),
                                  [](double flow) { return flow >= 1.2 && flow <= 2.3; });
  return {inside, listed(flows) + " /(m s)"};
}

Verdict drawn_doors(const std::vector<DoorFlows>& doors) {
  bool passed = true;
  std::string measured;
  double narrower = 0;
  for (const DoorFlows& door : doors) {
    const double middle = (door.min_per_s + door.max_per_s) / 2;
    const double apart = middle > 0 ? door.max_per_s / middle - 1 : 1;
    passed = passed && apart <= 0.15 && middle > narrower;
    narrower = middle;
    measured +=
        fmt::format("{}{:.2f} /s ± {:.0f} %", measured.empty() ? "" : ", ", middle, 100 * apart);
  }
  return {passed, measured};
}

Verdict exit_flow(const std::vector<ExitRun>& runs) {
  double flow = 0;
  bool all_out = true;
  for (const ExitRun& run : runs) {
    flow = std::max(flow, run.flow_per_s);
    all_out = all_out && run.all_out;
  }
  return {all_out && flow <= 1.33, fmt::format("{:.2f} /s{}", flow, all_out ? "" : ", jams")};
}

Verdict capacity_drop(double peak, double dense, double packed) {
  return {peak > 0 && dense <= 0.7 * peak && packed < 0.5,
          fmt::format("{:.2f}, {:.2f}, {:.2f} /(m s)", peak, dense, packed)};
}

Verdict open_square(double half_density, double full_density) {
  return {half_density <= kMaxStuck && full_density <= kMaxStuck,
          fmt::format("{:.0f} %, {:.0f} %", 100 * half_density, 100 * full_density)};
}

Verdict counter_flow(const CounterRun& alone, const std::vector<CounterRun>& against) {
  std::size_t left = alone.left;
  double time_s = 0;
  for (const CounterRun& run : against) {
    left += run.left;
    time_s = std::max(time_s, run.time_s);
  }
  return {left == 0 && time_s <= 2.5 * alone.time_s,
          fmt::format("{:.0f}, {:.0f} s{}", alone.time_s, time_s, left == 0 ? "" : ", jams")};
}

Verdict two_way(const std::vector<TwoWayRun>& runs, double each) {
  double out = std::numeric_limits<double>::infinity();
  double stuck = 0;
  for (const TwoWayRun& run : runs) {
    out = std::min({out, run.there, run.back});
    stuck = std::max(stuck, run.stuck);
  }
  return {out >= 0.75 * each && stuck <= kMaxStuck,
          fmt::format("{:.2f} /(m s), {:.0f} % stuck", out, 100 * stuck)};
}

Verdict corner_flow(const std::vector<CornerFlow>& flows) {
  std::string measured;
  bool passed = true;
  for (const CornerFlow& flow : flows) {
    passed = passed && flow.straight > 0 && std::min(flow.block, flow.thin) >= 0.85 * flow.straight;
    measured += fmt::format("{}{:.2f}, {:.2f}, {:.2f}", measured.empty() ? "" : "; ", flow.straight,
                            flow.block, flow.thin);
  }
  return {passed, measured + " /(m s)"};
}

Verdict evasion(const MeetingRun& run) {
  return {run.passed && run.begins_s >= 2 && run.acceleration_mps2 <= 1,
          fmt::format("{:.1f} s, {:.1f} m/s²{}", run.begins_s, run.acceleration_mps2,
                      run.passed ? "" : ", they touch")};
}

Verdict calm(const std::vector<CalmRun>& runs) {
  CalmRun worst;
  for (const CalmRun& run : runs) {
    worst.turns = std::max(worst.turns, run.turns);
    worst.slow_yaw_rate_deg_s = std::max(worst.slow_yaw_rate_deg_s, run.slow_yaw_rate_deg_s);
    worst.overlap_m = std::max(worst.overlap_m, run.overlap_m);
  }
  return {worst.turns < 1 && worst.slow_yaw_rate_deg_s < 30 && worst.overlap_m <= 0.02,
          fmt::format("{:.1f} turns, {:.0f}°/s, {:.1f} cm", worst.turns, worst.slow_yaw_rate_deg_s,
                      100 * worst.overlap_m)};
}

Verdict same_capacity(const std::vector<double>& flows) {
  std::string measured;
  for (const double flow : flows) measured += fmt::format("{:.2f} ", flow);
  const auto [least, greatest] = std::minmax_element(flows.begin(), flows.end());
  return {!flows.empty() && *least > 0 && *greatest <= 1.1 * *least, measured + "/(m s)"};
}

Verdict queue(const QueueRun& run) {
  return {run.passed > 0 && run.turns < 1,
          fmt::format("{:.1f} turns, {:.1f} stops", run.turns, run.stops)};
}

}  // namespace throng::validation::criteria
