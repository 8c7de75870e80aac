#include "spec/camera/camera_spec.h"

#include <cmath>

#include "base/geometry/angle.h"

namespace throng::camera {

std::optional<Distortion> LensSpec::distortion() const {
  using Model = Distortion::Model;
  if (model == LensModel::brown_conrady) {
    return Distortion(Model::brown_conrady, {k1, k2, p1, p2, k3, k4, k5, k6});
  }
  if (model == LensModel::fisheye) return Distortion(Model::fisheye, {k1, k2, k3, k4});
  return std::nullopt;
}

std::optional<Intrinsics> CameraSpec::intrinsics() const {
  if (calibrated) return calibrated;
  Intrinsics k = intrinsics_from_hfov(width, height, hfov_deg * kDegree);
  k.distortion = lens.distortion();
  if (fx_px) {
    k.fx_px = *fx_px;
    k.fy_px = fy_px.value_or(k.fx_px);
  } else if (k.distortion) {
    // The focal length with which the lens shows half the angle at the image's edge.
    const auto edge = k.distortion->distort({std::tan(0.5 * hfov_deg * kDegree), 0});
    if (!edge || !(edge->x() > 0)) return std::nullopt;
    k.fx_px = 0.5 * width / edge->x();
    k.fy_px = k.fx_px;
  }
  k.cx_px = cx_px.value_or(k.cx_px);
  k.cy_px = cy_px.value_or(k.cy_px);
  return k;
}

double CameraSpec::pinhole_hfov_rad() const {
  if (fx_px) return 2 * std::atan(0.5 * width / *fx_px);
  return hfov_deg * kDegree;
}

}  // namespace throng::camera
