#include "formats/dataset/image_camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "spec/annotate/outlines.h"

namespace throng::formats {

using nlohmann::json;

camera::Camera image_camera(const Image& image) {
  using camera::Distortion;
  camera::Camera camera;
  const Eigen::Matrix3d& K = image.camera_matrix;
  camera.intrinsics = {image.width, image.height, K(0, 0), K(1, 1), K(0, 2), K(1, 2)};
  camera.intrinsics.skew_px = K(0, 1);
  camera.pose = {image.R, image.t};
  const json& record = image.record.at("camera");
  const std::string model = record.value("model", "pinhole");
  if (model == "pinhole") return camera;
  const bool is_fisheye = model == "fisheye";
  Distortion::Coefficients coefficients{};
  std::size_t i = 0;
  for (const char* name :
       {"k1", "k2", is_fisheye ? "k3" : "p1", is_fisheye ? "k4" : "p2", "k3", "k4", "k5", "k6"}) {
    if (is_fisheye && i == 4) break;
    coefficients.at(i++) = record.at("distortion").value(name, 0.0);
  }
  camera.intrinsics.distortion.emplace(
      is_fisheye ? Distortion::Model::fisheye : Distortion::Model::brown_conrady, coefficients);
  return camera;
}

namespace {

Eigen::AlignedBox2d amodal_limit(const Image& image) {
  const Eigen::Vector2d size(image.width, image.height);
  const bool is_pinhole =
      image.record.value("camera", json::object()).value("model", "pinhole") == "pinhole";
  const double share = is_pinhole ? 1 : 1.0 / annotate::kLensMarginDivisor;
  return {-share * size, (1 + share) * size};
}

}  // namespace

Eigen::Vector2d in_amodal_limit(const Image& image, const Eigen::Vector2d& point) {
  const Eigen::AlignedBox2d limit = amodal_limit(image);
  return point.cwiseMax(limit.min()).cwiseMin(limit.max());
}

bool reaches_amodal_limit(const Image& image, const Box& box) {
  constexpr double kSlackPx = 0.02;
  const Eigen::AlignedBox2d limit = amodal_limit(image);
  return box.x <= limit.min().x() + kSlackPx || box.y <= limit.min().y() + kSlackPx ||
         box.x + box.width >= limit.max().x() - kSlackPx ||
         box.y + box.height >= limit.max().y() - kSlackPx;
}

double pixels_across(const camera::Camera& camera, const Eigen::Vector3d& world, double size_m) {
  constexpr double kMinDistanceM = 0.1;
  const camera::Intrinsics& k = camera.intrinsics;
  const Eigen::Vector3d p = camera.pose.R * world + camera.pose.t;
  const double pinhole_px = size_m * k.fx_px / std::max(p.z(), kMinDistanceM);
  if (!k.distortion || p.z() < kMinDistanceM) return pinhole_px;
  const Eigen::Vector3d side = p.unitOrthogonal();
  double sum_px = 0;
  for (const Eigen::Vector3d& across : {side, Eigen::Vector3d(p.normalized().cross(side))}) {
    const Eigen::Vector3d first = p - size_m / 2 * across;
    const Eigen::Vector3d last = p + size_m / 2 * across;
    if (first.z() <= 0 || last.z() <= 0) return pinhole_px;
    const auto a = k.pixel_of(first.hnormalized());
    const auto b = k.pixel_of(last.hnormalized());
    if (!a || !b) return pinhole_px;
    sum_px += (*b - *a).norm();
  }
  return sum_px / 2;
}

}  // namespace throng::formats
