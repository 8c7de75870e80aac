#include "calibration/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/robust.h"

namespace throng::calibrate {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr Eigen::Index kPoseUnknowns = 6;

void take_lens(const Adjustment& adjustment, const Linearization& derivatives,
               Calibration& calibration) {
  calibration.parameters = adjustment.parameters;
  calibration.places = derivatives.places;
  calibration.sd.fill(0);
  const auto free = static_cast<Eigen::Index>(derivatives.places.size());
  const bool known = derivatives.covariance.size() > 0 || free == 0;
  if (known) calibration.covariance = derivatives.covariance.topLeftCorner(free, free);
  for (Eigen::Index i = 0; i < free; ++i) {
    calibration.sd.at(derivatives.places[static_cast<std::size_t>(i)]) =
        known ? std::sqrt(calibration.covariance(i, i)) : kUnknown;
  }
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::size_t source = adjustment.rules.source[i];
    if (source != i) {
      calibration.sd[i] = std::abs(adjustment.rules.ratio[i]) * calibration.sd[source];
    }
  }
}

void take_views(const Adjustment& adjustment, const Linearization& derivatives,
                const std::vector<std::string>& names, Calibration& calibration) {
  calibration.views.clear();
  for (std::size_t v = 0; v < names.size(); ++v) {
    ViewResult view;
    view.name = names[v];
    view.pose = adjustment.poses[v];
    const auto first = static_cast<Eigen::Index>(derivatives.places.size()) +
                       kPoseUnknowns * static_cast<Eigen::Index>(v);
    if (derivatives.covariance.rows() >= first + kPoseUnknowns) {
      view.pose_sd = derivatives.covariance.diagonal().segment<kPoseUnknowns>(first).cwiseSqrt();
    } else {
      view.pose_sd.setConstant(kUnknown);
    }
    calibration.views.push_back(std::move(view));
  }
  for (const Observation& seen : adjustment.observations) {
    calibration.views[seen.view].points.push_back(
        {adjustment.points[seen.point].position, seen.pixel, adjustment.residual(seen), seen.used});
  }
  for (ViewResult& view : calibration.views) {
    double sum = 0;
    for (const PointResult& point : view.points) {
      if (point.used) sum += point.residual.squaredNorm();
    }
    view.rms_px = std::sqrt(sum / static_cast<double>(view.used()));
  }
}

}  // namespace

std::size_t ViewResult::used() const {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const PointResult& p) { return p.used; }));
}

camera::Intrinsics Calibration::intrinsics() const {
  return to_intrinsics(lens, parameters, size.width, size.height);
}

void take_results(const Adjustment& adjustment, const Fit& fit,
                  const std::vector<std::string>& names, Calibration& calibration) {
  calibration.lens = adjustment.lens;
  calibration.rms_px = fit.rms_px;
  calibration.sigma_px = fit.sigma_px;
  calibration.points = fit.used;
  calibration.rejected = fit.rejected;
  calibration.iterations = fit.iterations;
  calibration.converged = fit.converged;
  take_lens(adjustment, fit.derivatives, calibration);
  take_views(adjustment, fit.derivatives, names, calibration);
}

}  // namespace throng::calibrate
