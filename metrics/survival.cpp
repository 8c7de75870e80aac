#include "metrics/survival.h"

#include <algorithm>

namespace throng::metrics {

std::optional<double> time_by_which(std::vector<Watched> people, int percent) {
  constexpr double kRounding = 1e-9;
  // At one time, what happened comes first: who stops being watched then was there to see it.
  std::sort(people.begin(), people.end(), [](const Watched& one, const Watched& other) {
    return one.time_s != other.time_s ? one.time_s < other.time_s : one.happened > other.happened;
  });
  double left = 1;
  auto watched = static_cast<double>(people.size());
  for (const Watched& person : people) {
    if (person.happened) left *= (watched - 1) / watched;
    watched -= 1;
    if (person.happened && left <= 1 - 0.01 * percent + kRounding) return person.time_s;
  }
  return std::nullopt;
}

std::optional<double> time_by_which(const std::vector<double>& times_s, int people, int percent) {
  const std::size_t needed =
      (static_cast<std::size_t>(people) * static_cast<std::size_t>(percent) + 99) / 100;
  if (needed == 0 || needed > times_s.size()) return std::nullopt;
  return times_s[needed - 1];
}

}  // namespace throng::metrics
