#include "metrics/basis/survival.h"

#include <algorithm>

namespace throng::metrics {

namespace {

constexpr double kWatchSlackS = 1e-6;

}  // namespace

std::vector<Survival> estimate_survival(std::vector<Watched> people) {
  // At one time, what happened comes first: who stops being watched then was there to see it.
  std::sort(people.begin(), people.end(), [](const Watched& one, const Watched& other) {
    return one.time_s != other.time_s ? one.time_s < other.time_s : one.happened > other.happened;
  });
  std::vector<Survival> steps;
  double left = 1;
  auto watched = static_cast<double>(people.size());
  for (const Watched& person : people) {
    if (person.happened) {
      left *= (watched - 1) / watched;
      if (steps.empty() || steps.back().time_s != person.time_s)
        steps.push_back({person.time_s, 1});
      steps.back().share = left;
    }
    watched -= 1;
  }
  return steps;
}

std::optional<double> time_by_which(const std::vector<Watched>& people, int percent) {
  constexpr double kRounding = 1e-9;
  for (const Survival& step : estimate_survival(people)) {
    if (step.share <= 1 - 0.01 * percent + kRounding) return step.time_s;
  }
  return std::nullopt;
}

std::optional<double> time_by_which(const std::vector<double>& times_s, int people, int percent) {
  const std::size_t needed =
      (static_cast<std::size_t>(people) * static_cast<std::size_t>(percent) + 99) / 100;
  if (needed == 0 || needed > times_s.size()) return std::nullopt;
  return times_s[needed - 1];
}

std::optional<double> restricted_mean_s(const std::vector<Watched>& people, double until_s) {
  if (people.empty()) return std::nullopt;
  double area_s = 0;
  double from_s = 0;
  double left = 1;
  for (const Survival& step : estimate_survival(people)) {
    if (step.time_s >= until_s) break;
    area_s += left * (step.time_s - from_s);
    from_s = step.time_s;
    left = step.share;
  }
  const auto longest = std::max_element(
      people.begin(), people.end(),
      [](const Watched& one, const Watched& other) { return one.time_s < other.time_s; });
  if (left > 0 && longest->time_s < until_s - kWatchSlackS) return std::nullopt;
  return area_s + left * (until_s - from_s);
}

}  // namespace throng::metrics
