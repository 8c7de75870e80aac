#include "metrics/trajectories/frame_times.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace throng::metrics {

namespace {

constexpr double kSameS = 1e-6;  // Unix times are doubles, with steps of 0.2 µs
constexpr double kNoise = 0.01;  // of a frame
constexpr std::array kUsualRates = {1.0,  2.0,   2.5,   3.0,   4.0,   5.0,   6.0,   7.5,
                                    8.0,  10.0,  12.0,  12.5,  15.0,  16.0,  20.0,  24.0,
                                    25.0, 30.0,  40.0,  48.0,  50.0,  60.0,  75.0,  80.0,
                                    90.0, 100.0, 120.0, 200.0, 240.0, 250.0, 500.0, 1000.0};
constexpr std::array kNtscRates = {30000.0 / 1001, 24000.0 / 1001, 60000.0 / 1001, 15000.0 / 1001,
                                   120000.0 / 1001};

/// The greatest power of ten (s) of which all times are multiples; 0 if none above noise is one.
double rounding_unit(const DistinctTimes& times) {
  constexpr int kMaxDigits = 4;
  for (int digits = -1; digits <= kMaxDigits; ++digits) {
    const double per_s = std::pow(10, digits);
    const bool are_multiples = std::all_of(times.begin(), times.end(), [&](double time) {
      return std::abs(time - std::round(time * per_s) / per_s) <= kSameS;
    });
    if (are_multiples) return 1 / per_s;
  }
  return 0;
}

/// The rate with three decimals, if it differs from that only as differences of times do.
double without_rounding(double rate) {
  constexpr double kSlack = 2e-6;  // of Unix times
  const double rounded = std::round(rate * 1000) / 1000;
  return std::abs(rate - rounded) <= kSlack * std::max(rate, 1.0) ? rounded : rate;
}

/// Steps that may be those between neighboring frames: their sum, number and extremes.
struct SingleSteps {
  double sum_s = 0;
  double count = 0;
  double min_s = 0;
  double max_s = 0;
};

SingleSteps single_steps(const DistinctTimes& times, double median_s, double unit_s) {
  const double max_step_s = std::max(1.5 * median_s, median_s + unit_s) + kSameS;
  SingleSteps steps{.min_s = median_s, .max_s = median_s};
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double step_s = times[i] - times[i - 1];
    if (step_s > max_step_s) continue;
    steps.sum_s += step_s;
    ++steps.count;
    steps.min_s = std::min(steps.min_s, step_s);
    steps.max_s = std::max(steps.max_s, step_s);
  }
  return steps;
}

struct Range {
  double min = 0;
  double max = 0;
};

/// Rates in a range, the simplest first; `likely` is one of them.
std::vector<double> simple_rates(const Range& rates, double likely) {
  std::vector<double> simple;
  const auto add = [&](double rate) {
    if (rate >= rates.min && rate <= rates.max) simple.push_back(rate);
  };
  for (const double rate : kUsualRates) add(rate);
  std::sort(simple.begin(), simple.end(),
            [&](double a, double b) { return std::abs(a - likely) < std::abs(b - likely); });
  // Missing frames make few others likely: 33 Hz is not 50 Hz of which a third is missing.
  constexpr double kNear = 0.15;
  const auto far = std::find_if(simple.begin(), simple.end(), [&](double rate) {
    return std::abs(rate - likely) > kNear * likely;
  });
  const std::vector<double> last(far, simple.end());
  simple.erase(far, simple.end());
  for (const double rate : kNtscRates) add(rate);
  constexpr int kMaxDecimals = 3;
  for (int decimals = 0; decimals <= kMaxDecimals; ++decimals) {
    const double per_unit = std::pow(10, decimals);
    add(std::round(likely * per_unit) / per_unit);
  }
  simple.push_back(likely);
  simple.insert(simple.end(), last.begin(), last.end());
  return simple;
}

/// Narrows the range of periods (s) to those by which the times can differ if each is off its
/// frame by at most half of `slack_s`; nothing if there are none. Differences over ever more times
/// are looked at, as long as only one number of frames fits them.
std::optional<Range> possible_periods(const DistinctTimes& times, Range periods, double slack_s) {
  constexpr double kRounding = 1e-9;
  for (std::size_t stride = 1; stride < times.size(); stride *= 2) {
    for (std::size_t i = stride; i < times.size(); ++i) {
      const double apart_s = times[i] - times[i - stride];
      const double least = std::ceil((apart_s - slack_s) / periods.max - kRounding);
      const double most = std::floor((apart_s + slack_s) / periods.min + kRounding);
      if (least > most || most < 1) return std::nullopt;
      if (std::max(least, 1.0) < most) continue;
      periods.min = std::max(periods.min, (apart_s - slack_s) / most);
      periods.max = std::min(periods.max, (apart_s + slack_s) / most);
    }
  }
  return periods;
}

/// Whether all steps are multiples of the median one, which is not the unit of rounding (or they
/// are equal). Then `median_s` becomes their mean.
bool is_exact(const DistinctTimes& times, double unit_s, double& median_s) {
  const double whole = std::round((times.back() - times.front()) / median_s);
  const double mean_s = (times.back() - times.front()) / whole;
  if (median_s < 1.5 * unit_s && whole >= static_cast<double>(times.size())) return false;
  for (const double time : times) {
    const double since_s = time - times.front();
    if (std::abs(since_s - std::round(since_s / mean_s) * mean_s) > kSameS) return false;
  }
  median_s = mean_s;
  return true;
}

std::optional<FrameTimes> frames_within(const DistinctTimes& times, double rate, double unit_s) {
  const double slack = std::max(unit_s * rate, kNoise) + kSameS * rate;
  constexpr double kMaxSlack = 1 + kNoise;  // beyond, the unit does not tell frames apart
  if (slack > kMaxSlack) return std::nullopt;
  std::vector<double> phases;
  phases.reserve(times.size());
  for (const double time : times) phases.push_back(time * rate - std::floor(time * rate));
  std::sort(phases.begin(), phases.end());
  // All phases lie in the part of the circle that the widest gap leaves.
  double start = phases.front();
  double gap = start + 1 - phases.back();
  for (std::size_t i = 1; i < phases.size(); ++i) {
    if (phases[i] - phases[i - 1] <= gap) continue;
    gap = phases[i] - phases[i - 1];
    start = phases[i];
  }
  if (1 - gap > slack) return std::nullopt;
  const double middle = start + 0.5 * (1 - gap);
  const FrameTimes frames{rate, middle - std::round(middle)};
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double before = std::round(times[i - 1] * rate - frames.phase);
    if (std::round(times[i] * rate - frames.phase) <= before) return std::nullopt;
  }
  return frames;
}

/// As find_frames(), where one frame is the given step within rounding.
std::optional<FrameTimes> frames_by_step(const DistinctTimes& times, double unit_s, double step_s) {
  if (is_exact(times, unit_s, step_s)) {
    return frames_within(times, without_rounding(1 / step_s), unit_s);
  }
  const double slack_s = std::max(unit_s, kNoise * step_s) + kSameS;
  const auto periods =
      possible_periods(times, {std::max(step_s - slack_s, unit_s), step_s + slack_s}, slack_s);
  if (!periods) return std::nullopt;
  const SingleSteps steps = single_steps(times, step_s, unit_s);
  const double likely_s = std::clamp(steps.sum_s / steps.count, periods->min, periods->max);
  const Range rates{1 / periods->max, 1 / periods->min};
  for (const double rate : simple_rates(rates, 1 / likely_s)) {
    if (const auto frames = frames_within(times, rate, unit_s)) return frames;
  }
  return frames_within(times, 2 / (periods->min + periods->max), unit_s);
}

}  // namespace

double median_step(const DistinctTimes& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

std::optional<FrameTimes> frames_at_rate(const DistinctTimes& times, double frames_per_s) {
  return frames_within(times, frames_per_s, rounding_unit(times));
}

std::optional<FrameTimes> find_frames(const DistinctTimes& times) {
  return frames_by_step(times, rounding_unit(times), median_step(times));
}

std::optional<FrameTimes> find_sparse_frames(const DistinctTimes& times) {
  constexpr double kMinUnits = 4;  // less may be nothing but rounding
  const double unit_s = rounding_unit(times);
  double shortest_s = median_step(times);
  for (std::size_t i = 1; i < times.size(); ++i) {
    shortest_s = std::min(shortest_s, times[i] - times[i - 1]);
  }
  if (shortest_s < kMinUnits * unit_s) return std::nullopt;
  return frames_by_step(times, unit_s, shortest_s);
}

double mean_rate(const DistinctTimes& times) {
  const SingleSteps steps = single_steps(times, median_step(times), 0);
  const double rate = steps.count / steps.sum_s;
  const double uncertain = (steps.max_s - steps.min_s) / steps.sum_s;
  return simple_rates({rate * (1 - uncertain), rate * (1 + uncertain)}, rate).front();
}

}  // namespace throng::metrics
