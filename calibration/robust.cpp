#include "calibration/robust.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace throng::calibrate {

namespace {

/// Scale of the loss under which outliers are looked for (px): they are pixels off, corners a few
/// tenths.
constexpr double kSearchLossPx = 1;
/// Accurate enough to detect outliers.
constexpr double kSearchTolerance = 1e-4;

std::vector<double> view_sigmas(const Adjustment& adjustment,
                                const std::vector<Eigen::Vector2d>& residuals, double& overall) {
  std::vector<std::vector<double>> by_view(adjustment.poses.size());
  std::vector<double> all;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!residuals[i].allFinite()) continue;
    for (const double r : residuals[i]) {
      by_view[adjustment.observations[i].view].push_back(r);
      all.push_back(r);
    }
  }
  overall = robust_sigma(std::move(all));
  std::vector<double> sigmas;
  sigmas.reserve(by_view.size());
  for (auto& values : by_view) sigmas.push_back(robust_sigma(std::move(values)));
  return sigmas;
}

/// Whether the marks changed.
bool mark_outliers(Adjustment& adjustment, double min_px) {
  std::vector<Eigen::Vector2d> residuals;
  residuals.reserve(adjustment.observations.size());
  for (const Observation& seen : adjustment.observations) {
    residuals.push_back(adjustment.residual(seen));
  }
  double overall = 0;
  const std::vector<double> sigmas = view_sigmas(adjustment, residuals, overall);
  // A view that is worse than this is not unsharp, but wrong.
  constexpr double kMaxUnsharp = 4;
  bool changed = false;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    Observation& seen = adjustment.observations[i];
    const double max_residual_px = std::max(
        min_px, kOutlierSigmas * std::clamp(sigmas[seen.view], overall, kMaxUnsharp * overall));
    const bool used = residuals[i].norm() <= max_residual_px;  // false for NaN
    changed = changed || used != seen.used;
    seen.used = used;
  }
  return changed;
}

double sum_of_squares(const Adjustment& adjustment) {
  double sum = 0;
  for (const Observation& seen : adjustment.observations) {
    if (seen.used) sum += adjustment.residual(seen).squaredNorm();
  }
  return sum;
}

/// Priors are weighed against the pixels' standard deviation, which has to be known for that.
bool weighs_knowledge(const Adjustment& adjustment) {
  return std::any_of(adjustment.rules.priors.begin(), adjustment.rules.priors.end(),
                     [](const auto& prior) { return prior.has_value(); }) ||
         std::any_of(adjustment.points.begin(), adjustment.points.end(),
                     [](const WorldPoint& point) { return point.sd && *point.sd > 0; });
}

/// `first`: nothing is known of outliers yet.
void solve_without_outliers(Adjustment& adjustment, const FitOptions& options, bool first,
                            Fit& fit) {
  SolveOptions plain;
  plain.loss_px = options.loss_px;
  plain.should_continue = options.should_continue;
  const auto run = [&](const SolveOptions& how) {
    const SolveReport report = solve(adjustment, how);
    fit.converged = report.converged;
    fit.iterations += report.iterations;
  };
  if (options.reject && first) {
    SolveOptions search = plain;
    search.loss_px = kSearchLossPx;
    search.tolerance = kSearchTolerance;
    run(search);
    mark_outliers(adjustment, options.outlier_px);
  }
  run(plain);
  constexpr int kMaxRounds = 6;
  for (int round = 0; options.reject && round < kMaxRounds; ++round) {
    if (!mark_outliers(adjustment, options.outlier_px)) break;
    run(plain);
  }
}

}  // namespace

double robust_sigma(std::vector<double> values) {
  if (values.empty()) return 0;
  constexpr double kNormal = 1.4826;
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return kNormal * *middle;
}

Fit fit(Adjustment& adjustment, const FitOptions& options) {
  Fit result;
  const double sigma_before = adjustment.sigma_px;
  adjustment.sigma_px = options.sigma_px.value_or(sigma_before);
  solve_without_outliers(adjustment, options, true, result);
  constexpr double kMinSigmaPx = 1e-6;
  const auto estimate = [&] {
    const std::ptrdiff_t surplus = adjustment.surplus();
    result.sigma_px = surplus > 0
                          ? std::sqrt(sum_of_squares(adjustment) / static_cast<double>(surplus))
                          : std::numeric_limits<double>::quiet_NaN();
    const double before = adjustment.sigma_px;
    if (!options.sigma_px && surplus > 0) {
      adjustment.sigma_px = std::max(result.sigma_px, kMinSigmaPx);
    }
    return std::abs(adjustment.sigma_px / before - 1);
  };
  double change = estimate();
  constexpr double kSame = 0.05;
  constexpr int kRounds = 3;
  for (int i = 0; i < kRounds && change > kSame && weighs_knowledge(adjustment); ++i) {
    solve_without_outliers(adjustment, options, false, result);
    change = estimate();
  }
  result.derivatives = linearize(adjustment);
  for (const Observation& seen : adjustment.observations) {
    ++(seen.used ? result.used : result.rejected);
  }
  result.rms_px = std::sqrt(sum_of_squares(adjustment) / static_cast<double>(result.used));
  return result;
}

}  // namespace throng::calibrate
