#include "calibration/lens_fit.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "calibration/initialize.h"
#include "calibration/repeated_views.h"
#include "calibration/warnings.h"
#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

namespace {

/// Above this (px) a solution is taken for a wrong minimum, and another guess is tried.
constexpr double kDoubtfulRmsPx = 2;
constexpr std::size_t kMaxGuesses = 6;
/// A view with a larger share of outliers is wrong as a whole.
constexpr double kMaxOutliers = 0.5;

struct Solved {
  Adjustment adjustment;
  Fit fit;
};

/// Views that the estimated focal lengths and principal point need: each planar view gives two
/// equations for them (Zhang 2000), one that is not planar fixes them all.
void require_enough_views(const Correspondences& all, const Rules& rules,
                          const std::string& source) {
  int unknowns = 0;
  for (std::size_t i = 0; i <= kSkew; ++i) unknowns += rules.free[i] && !rules.priors[i] ? 1 : 0;
  int equations = 0;
  std::size_t distinct = 0;
  const std::vector<std::size_t> first = first_alike(all.views);
  for (std::size_t v = 0; v < all.views.size(); ++v) {
    if (first[v] != v) continue;
    equations += fit_plane(all.views[v].points) ? 2 : 5;
    ++distinct;
  }
  if (distinct > 0 && equations >= unknowns) return;
  std::string found = fmt::format("{} usable views", all.views.size());
  if (distinct < all.views.size()) {
    found += fmt::format(", of which {} show the object in different places", distinct);
  }
  std::vector<Problem> problems = {
      {source, "", std::move(found),
       fmt::format("at least {} different ones of a flat object, since {} of fx, fy, cx, cy and "
                   "skew are to be "
                   "estimated; more if parameters are not fixed, tied or given priors",
                   std::max(1, (unknowns + 1) / 2), unknowns)}};
  problems.insert(problems.end(), all.left_out.begin(), all.left_out.end());
  throw InputError(problems);
}

Adjustment adjust_intrinsics(const Correspondences& all, Lens lens, const Rules& rules,
                             const Guess& guess) {
  Adjustment adjustment;
  adjustment.lens = lens;
  adjustment.rules = rules;
  adjustment.parameters = guess.parameters;
  adjustment.poses = guess.poses;
  for (std::size_t v = 0; v < all.views.size(); ++v) {
    const View& view = all.views[v];
    for (std::size_t i = 0; i < view.points.size(); ++i) {
      adjustment.observations.push_back({v, adjustment.points.size(), view.pixels[i], true});
      adjustment.points.push_back({view.points[i], 0, view.points[i]});
    }
  }
  return adjustment;
}

Solved solve_views(const Correspondences& all, Lens lens, const Rules& rules,
                   const IntrinsicsOptions& options) {
  const std::vector<Guess> starts = guesses(all, lens, rules);
  std::optional<Solved> best;
  for (std::size_t i = 0; i < std::min(starts.size(), kMaxGuesses); ++i) {
    Solved tried{adjust_intrinsics(all, lens, rules, starts[i]), {}};
    tried.fit = fit(tried.adjustment, options.fit);
    const auto worth = [](const Solved& s) {
      const double rejected =
          static_cast<double>(s.fit.rejected) / static_cast<double>(s.fit.rejected + s.fit.used);
      return std::isfinite(s.fit.rms_px) ? s.fit.rms_px * (1 + 10 * rejected) : INFINITY;
    };
    if (!best || worth(tried) < worth(*best)) best = std::move(tried);
    if (worth(*best) < kDoubtfulRmsPx) break;
  }
  if (!best || !std::isfinite(best->fit.rms_px)) {
    throw InputError(Problem{options.source, "", "views that no lens and poses explain",
                             "points and pixels that belong together, and their right image size"});
  }
  return std::move(*best);
}

/// Views whose points mostly disagree with all others.
std::vector<std::size_t> wrong_views(const Solved& solved) {
  std::vector<std::size_t> seen(solved.adjustment.poses.size(), 0);
  std::vector<std::size_t> used = seen;
  for (const Observation& o : solved.adjustment.observations) {
    ++seen[o.view];
    used[o.view] += o.used ? 1 : 0;
  }
  std::vector<std::size_t> wrong;
  for (std::size_t v = 0; v < seen.size(); ++v) {
    const auto outliers = static_cast<double>(seen[v] - used[v]);
    if (used[v] < kMinPoints || outliers > kMaxOutliers * static_cast<double>(seen[v])) {
      wrong.push_back(v);
    }
  }
  return wrong;
}

void leave_out(Correspondences& all, const std::vector<std::size_t>& wrong) {
  for (auto v = wrong.rbegin(); v != wrong.rend(); ++v) {
    const View& view = all.views[*v];
    all.left_out.push_back(
        {view.name, "",
         fmt::format("most of its {} points disagree with the other views", view.points.size()),
         "points that one camera sees with the others"});
    all.views.erase(all.views.begin() + static_cast<std::ptrdiff_t>(*v));
  }
}

Calibration calibrate_with(Correspondences all, Lens lens, const Rules& rules,
                           const IntrinsicsOptions& options) {
  leave_out_copies(all);
  require_enough_views(all, rules, options.source);
  Solved solved = solve_views(all, lens, rules, options);
  for (auto wrong = wrong_views(solved); options.fit.reject && !wrong.empty();
       wrong = wrong_views(solved)) {
    leave_out(all, wrong);
    require_enough_views(all, rules, options.source);
    solved = solve_views(all, lens, rules, options);
  }
  Calibration result;
  result.kind = "intrinsics";
  result.size = all.size;
  result.left_out = all.left_out;
  std::vector<std::string> names;
  names.reserve(all.views.size());
  for (const View& view : all.views) names.push_back(view.name);
  take_results(solved.adjustment, solved.fit, names, result);
  require_principal_point_inside({result.lens, result.parameters, result.size}, options.source);
  add_intrinsics_warnings(rules, solved.fit, result);
  return result;
}

}  // namespace

Calibration calibrate_lens(const Correspondences& all, const IntrinsicsOptions& options) {
  return calibrate_with(all, options.lens,
                        calibration_rules(options.lens, options.settings, options.source), options);
}

}  // namespace throng::calibrate
