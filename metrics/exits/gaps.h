// The gaps between passages of a door, bursts, and the tail of the gaps' distribution.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

namespace throng::metrics {

/// A power law pdf ~ t^-alpha, fitted by maximum likelihood to the gaps of at least `from_s`, which
/// is chosen for the min Kolmogorov-Smirnov distance (Clauset, Shalizi and Newman, SIAM Review 51,
/// 2009, eq. 3.1).
struct GapTail {
  double alpha = 0;
  double standard_error = 0;  ///< (alpha - 1) / sqrt(gaps)
  double from_s = 0;
  int gaps = 0;
  double distance = 0;  ///< Kolmogorov-Smirnov distance
  /// Whether the distance is below the 5 % point of Kolmogorov's distribution, 1.36 / sqrt(gaps).
  /// Since the law was fitted to the same gaps, some distributions pass that are no power laws.
  bool plausible() const { return distance * distance * gaps < 1.36 * 1.36; }
  /// Whether the mean gap diverges, which defines clogging (Zuriguel et al., Sci. Rep. 4, 7324,
  /// 2014).
  bool clogging_regime() const { return plausible() && alpha <= 2; }
};

/// Min number of gaps in a tail for a fit.
inline constexpr int kMinInTail = 50;

/// Fits a power law to the tail of the gaps; gaps of 0 are ignored. Nothing if every tail has fewer
/// than kMinInTail gaps or only equal gaps.
std::optional<GapTail> fit_tail(std::vector<double> gaps_s);

/// Max gaps (s) between the passages of a burst.
inline constexpr std::array kBurstGapsS = {1.0, 2.0, 3.0};

/// Metrics of the gaps of a door.
struct GapFigures {
  std::vector<double> gaps_s;  ///< between consecutive passages outward, in order of time
  std::optional<double> median_s, p90_s, max_duration_s;  ///< nothing without gaps
  std::optional<double> long_share;  ///< share of gaps longer than clog_after_s
  /// Per element of kBurstGapsS: the numbers of passages in the maximal sequences with shorter
  /// gaps.
  std::array<std::vector<int>, kBurstGapsS.size()> bursts;
  std::optional<GapTail> tail;
};

/// Computes the figures of a door. `crossings_s`: sorted times of the passages. `clog_after_s`:
/// limit for long gaps.
GapFigures gap_figures(std::span<const double> crossings_s, double clog_after_s);

nlohmann::json to_json(const GapFigures& figures);

}  // namespace throng::metrics
