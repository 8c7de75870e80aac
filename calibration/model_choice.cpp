#include "calibration/model_choice.h"
#include "calibration/lens_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace throng::calibrate {

namespace {

/// Points that the first, robust calibration used.
Correspondences used_in(const Calibration& calibration) {
  Correspondences used;
  used.size = calibration.size;
  for (const ViewResult& result : calibration.views) {
    View view{result.name, {}, {}};
    for (const PointResult& point : result.points) {
      if (!point.used) continue;
      view.points.push_back(point.point);
      view.pixels.push_back(point.pixel);
    }
    used.views.push_back(std::move(view));
  }
  return used;
}

/// Without settings for parameters that the lens does not have.
ParameterSettings settings_for(Lens lens, ParameterSettings settings) {
  const auto has = [&](const std::string& name) {
    for (std::size_t i = 0; i < kParameters; ++i) {
      if (parameter_name(lens, i) == name) return true;
    }
    return false;
  };
  std::erase_if(settings.fixed, [&](const auto& entry) { return !has(entry.first); });
  std::erase_if(settings.priors, [&](const auto& entry) { return !has(entry.first); });
  std::erase_if(settings.tied,
                [&](const auto& entry) { return !has(entry.first) || !has(entry.second.to); });
  return settings;
}

ModelScore score_model(const Calibration& calibration) {
  constexpr std::size_t kUnknownsOfAPose = 6;
  ModelScore score{calibration.lens, 0, calibration.rms_px, 0};
  score.unknowns = calibration.places.size() + kUnknownsOfAPose * calibration.views.size();
  const double sum =
      calibration.rms_px * calibration.rms_px * static_cast<double>(calibration.points);
  score.bic = bic(sum, 2 * calibration.points, score.unknowns);
  return score;
}

/// Whether a rational lens maps the whole image one to one, out to the corners that no point may
/// show: polynomials with large coefficients that cancel each other do not. Others are simple
/// enough not to follow the noise, and a fisheye may well see beyond the valid range.
bool is_lens_of_image(const Calibration& calibration) {
  if (calibration.lens != Lens::brown8) return true;
  const camera::Intrinsics lens = to_intrinsics(calibration.lens, calibration.parameters,
                                                calibration.size.width, calibration.size.height);
  if (!lens.distortion) return true;
  const double right = calibration.size.width - 1;
  const double bottom = calibration.size.height - 1;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(right, 0), Eigen::Vector2d(0, bottom),
        Eigen::Vector2d(right, bottom)}) {
    if (!lens.direction_of(corner)) return false;
  }
  return true;
}

}  // namespace

double bic(double sum_of_squares, std::size_t numbers, std::size_t unknowns) {
  const auto m = static_cast<double>(numbers);
  // Exact data would have -infinity for every model: what is better than this is as good.
  constexpr double kMinMean = 1e-16;
  return m * std::log(std::max(sum_of_squares / m, kMinMean)) +
         static_cast<double>(unknowns) * std::log(m);
}

Calibration calibrate_with_best_lens(const Correspondences& all, const IntrinsicsOptions& options) {
  IntrinsicsOptions with = options;
  with.choose_lens = false;
  const auto calibrate = [&](const Correspondences& views, Lens lens) {
    with.lens = lens;
    with.settings = settings_for(lens, options.settings);
    return calibrate_lens(views, with);
  };
  const Correspondences used = used_in(calibrate(all, Lens::brown5));
  with.fit.reject = false;
  std::vector<ModelScore> scores;
  for (const Lens lens : kLenses) {
    try {
      const Calibration tried = calibrate(used, lens);
      const bool open = tried.covariance.size() == 0 && !tried.places.empty();
      if (!open && tried.converged && is_lens_of_image(tried)) scores.push_back(score_model(tried));
    } catch (const InputError&) {
      continue;  // this lens explains nothing of it
    }
  }
  std::stable_sort(scores.begin(), scores.end(),
                   [](const ModelScore& a, const ModelScore& b) { return a.bic < b.bic; });
  with.fit.reject = options.fit.reject;
  // With all points, outliers among them, another lens may fail to converge.
  Calibration best = calibrate(all, scores.empty() ? Lens::brown5 : scores.front().lens);
  while (!best.converged && scores.size() > 1) {
    scores.erase(scores.begin());
    best = calibrate(all, scores.front().lens);
  }
  best.models = std::move(scores);
  return best;
}

}  // namespace throng::calibrate
