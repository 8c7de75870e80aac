#include "camera/calibration/model_choice.h"

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
Wishes wishes_for(Lens lens, Wishes wishes) {
  const auto has = [&](const std::string& name) {
    for (std::size_t i = 0; i < kParameters; ++i) {
      if (parameter_name(lens, i) == name) return true;
    }
    return false;
  };
  std::erase_if(wishes.fixed, [&](const auto& entry) { return !has(entry.first); });
  std::erase_if(wishes.priors, [&](const auto& entry) { return !has(entry.first); });
  std::erase_if(wishes.tied,
                [&](const auto& entry) { return !has(entry.first) || !has(entry.second.to); });
  return wishes;
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
    with.wishes = wishes_for(lens, options.wishes);
    return calibrate_intrinsics(views, with);
  };
  const Correspondences used = used_in(calibrate(all, Lens::brown5));
  with.fit.reject = false;
  std::vector<ModelScore> scores;
  for (const Lens lens : kLenses) {
    try {
      const Calibration tried = calibrate(used, lens);
      const bool open = tried.covariance.size() == 0 && !tried.places.empty();
      if (!open) scores.push_back(score_model(tried));
    } catch (const InputError&) {
      continue;  // this lens explains nothing of it
    }
  }
  std::stable_sort(scores.begin(), scores.end(),
                   [](const ModelScore& a, const ModelScore& b) { return a.bic < b.bic; });
  with.fit.reject = options.fit.reject;
  Calibration best = calibrate(all, scores.empty() ? Lens::brown5 : scores.front().lens);
  best.models = std::move(scores);
  return best;
}

}  // namespace throng::calibrate
