// The times between passages of a door: gaps, bursts and the tail of the gaps.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

namespace throng::metrics {

/// Exponent of a power law pdf ~ t^-alpha fitted to the gaps not shorter than `from_s` by maximum
/// likelihood; `from_s` is the one with the least Kolmogorov-Smirnov distance (Clauset, Shalizi and
/// Newman, SIAM Review 51, 2009, eq. 3.1).
struct GapTail {
  double alpha = 0;
  double standard_error = 0;  ///< (alpha - 1) / sqrt(gaps)
  double from_s = 0;
  int gaps = 0;
  double distance = 0;  ///< Kolmogorov-Smirnov
  /// Whether the distance is below the 5 % point of Kolmogorov's distribution, 1.36 / sqrt(gaps).
  /// As the law was fitted to the same gaps, this lets some pass that are no power laws.
  bool plausible() const { return distance * distance * gaps < 1.36 * 1.36; }
  /// The mean gap diverges: the regime of clogging (Zuriguel et al., Sci. Rep. 4, 7324, 2014).
  bool clogging_regime() const { return plausible() && alpha <= 2; }
};

/// Fewer gaps in a tail do not determine its law.
inline constexpr int kMinInTail = 50;

/// Empty if less than kMinInTail gaps would be in the tail, or all of them are equal.
std::optional<GapTail> fit_tail(std::vector<double> gaps_s);

inline constexpr std::array kBurstGapsS = {1.0, 2.0, 3.0};

struct GapFigures {
  std::vector<double> gaps_s;  ///< between consecutive passages outward, in order
  std::optional<double> median_s, p90_s, max_duration_s;  ///< empty without gaps
  std::optional<double> long_share;                       ///< of gaps longer than the clog time
  /// Per entry of kBurstGapsS: sizes of the longest runs of passages with shorter gaps, in order.
  std::array<std::vector<int>, kBurstGapsS.size()> bursts;
  std::optional<GapTail> tail;
};

/// `crossings_s`: times of the passages, in order. `clog_after_s`: when a gap is called long.
GapFigures gap_figures(std::span<const double> crossings_s, double clog_after_s);

nlohmann::json to_json(const GapFigures& figures);

}  // namespace throng::metrics
