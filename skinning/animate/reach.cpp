#include "skinning/animate/reach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace throng::skinning {

namespace {

// Axes along a bone, along the hinge, and across both.
Eigen::Matrix3f axes(const Eigen::Vector3f& along, const Eigen::Vector3f& hinge) {
  Eigen::Matrix3f result;
  result.col(0) = along.normalized();
  result.col(1) = (hinge - result.col(0) * result.col(0).dot(hinge)).normalized();
  result.col(2) = result.col(0).cross(result.col(1));
  return result;
}

}  // namespace

LimbTurn reach(const Limb& limb, const Eigen::Vector3f& target, const Eigen::Vector3f& bends_to) {
  const double upper = limb.upper.norm();
  const double lower = limb.lower.norm();
  // Never quite straight, so that the hinge's side is always known.
  constexpr double kAlmost = 0.9995;
  const double distance = std::clamp<double>(target.norm(), 1.02 * std::abs(upper - lower) + 1e-3,
                                             kAlmost * (upper + lower));
  const double cosine =
      (upper * upper + distance * distance - lower * lower) / (2 * upper * distance);
  const auto angle = static_cast<float>(std::acos(std::clamp(cosine, -1.0, 1.0)));
  const Eigen::Vector3f to_target = target.normalized();
  const Eigen::Vector3f hinge = to_target.cross(bends_to).normalized();
  const Eigen::Vector3f along = Eigen::AngleAxisf(angle, hinge) * to_target;
  const Eigen::Vector3f end = static_cast<float>(distance) * to_target;
  const Eigen::Vector3f onwards = end - static_cast<float>(upper) * along;
  const Eigen::Vector3f rest_hinge = limb.upper.cross(limb.bends_to).normalized();
  return {axes(along, hinge) * axes(limb.upper, rest_hinge).transpose(),
          axes(onwards, hinge) * axes(limb.lower, rest_hinge).transpose()};
}

double chord_m(const Limb& limb, double bend_rad) {
  const double upper = limb.upper.norm();
  const double lower = limb.lower.norm();
  return std::sqrt(upper * upper + lower * lower + 2 * upper * lower * std::cos(bend_rad));
}

}  // namespace throng::skinning
