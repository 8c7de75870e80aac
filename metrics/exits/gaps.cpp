#include "metrics/exits/gaps.h"
#include "base/compute/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace throng::metrics {

using nlohmann::json;

namespace {

// The fit to sorted[first...], and its distance.
std::optional<GapTail> tail_from(const std::vector<double>& sorted, std::size_t first) {
  const auto count = static_cast<double>(sorted.size() - first);
  const double from = sorted[first];
  double logs = 0;
  for (std::size_t i = first; i < sorted.size(); ++i) logs += std::log(sorted[i] / from);
  if (logs <= 0) return std::nullopt;
  GapTail tail;
  tail.alpha = 1 + count / logs;
  tail.standard_error = (tail.alpha - 1) / std::sqrt(count);
  tail.from_s = from;
  tail.gaps = static_cast<int>(sorted.size() - first);
  for (std::size_t i = first; i < sorted.size(); ++i) {
    const double law = 1 - std::pow(sorted[i] / from, 1 - tail.alpha);
    const auto below = static_cast<double>(i - first);
    tail.distance = std::max(
        {tail.distance, std::abs(law - below / count), std::abs((below + 1) / count - law)});
  }
  return tail;
}

std::vector<int> burst_sizes(std::span<const double> crossings_s, double shorter_than_s) {
  std::vector<int> sizes;
  for (std::size_t i = 0; i < crossings_s.size(); ++i) {
    const bool goes_on = i > 0 && crossings_s[i] - crossings_s[i - 1] < shorter_than_s;
    if (goes_on) {
      ++sizes.back();
    } else {
      sizes.push_back(1);
    }
  }
  return sizes;
}

template <typename T>
json or_null(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

// Reason why there is no exponent or it is meaningless.
json tail_json(const GapFigures& figures) {
  json result = {{"valid", figures.tail && figures.tail->plausible()},
                 {"why_not", nullptr},
                 {"fewest_gaps", kMinInTail}};
  if (!figures.tail) {
    const bool few = static_cast<int>(figures.gaps_s.size()) < kMinInTail;
    result["why_not"] = few ? "too few gaps" : "no tail of so many gaps that differ";
    return result;
  }
  const GapTail& tail = *figures.tail;
  if (!tail.plausible()) result["why_not"] = "the gaps do not follow a power law";
  result.update({{"alpha", tail.alpha},
                 {"standard_error", tail.standard_error},
                 {"from_s", tail.from_s},
                 {"gaps", tail.gaps},
                 {"kolmogorov_smirnov", tail.distance},
                 {"clogging_regime", tail.clogging_regime()}});
  return result;
}

}  // namespace

std::optional<GapTail> fit_tail(std::vector<double> gaps_s) {
  std::erase_if(gaps_s, [](double gap) { return gap <= 0; });
  std::sort(gaps_s.begin(), gaps_s.end());
  std::optional<GapTail> best;
  for (std::size_t first = 0; first + static_cast<std::size_t>(kMinInTail) <= gaps_s.size();
       ++first) {
    if (first > 0 && gaps_s[first] == gaps_s[first - 1]) continue;
    const auto tail = tail_from(gaps_s, first);
    if (tail && (!best || tail->distance < best->distance)) best = tail;
  }
  return best;
}

GapFigures gap_figures(std::span<const double> crossings_s, double clog_after_s) {
  GapFigures figures;
  for (std::size_t i = 1; i < crossings_s.size(); ++i) {
    figures.gaps_s.push_back(crossings_s[i] - crossings_s[i - 1]);
  }
  for (std::size_t i = 0; i < kBurstGapsS.size(); ++i) {
    figures.bursts[i] = burst_sizes(crossings_s, kBurstGapsS[i]);
  }
  if (figures.gaps_s.empty()) return figures;
  std::vector<double> sorted = figures.gaps_s;
  std::sort(sorted.begin(), sorted.end());
  figures.median_s = quantile_of_sorted(sorted, 0.5);
  figures.p90_s = quantile_of_sorted(sorted, 0.9);
  figures.max_duration_s = sorted.back();
  const auto is_long = [&](double gap) { return gap > clog_after_s; };
  figures.long_share = static_cast<double>(std::count_if(sorted.begin(), sorted.end(), is_long)) /
                       static_cast<double>(sorted.size());
  figures.tail = fit_tail(sorted);
  return figures;
}

json to_json(const GapFigures& figures) {
  json bursts = json::object();
  for (std::size_t i = 0; i < kBurstGapsS.size(); ++i) {
    bursts[fmt::format("gap_below_{:.0f}s", kBurstGapsS[i])] = figures.bursts[i];
  }
  return {{"count", figures.gaps_s.size()},
          {"median_s", or_null(figures.median_s)},
          {"p90_s", or_null(figures.p90_s)},
          {"longest_s", or_null(figures.max_duration_s)},
          {"share_longer_than_clog_time", or_null(figures.long_share)},
          {"list_s", figures.gaps_s},
          {"tail", tail_json(figures)},
          {"burst_sizes", std::move(bursts)}};
}

}  // namespace throng::metrics
