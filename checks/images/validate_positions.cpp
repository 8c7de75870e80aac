#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "annotate/rasters/density.h"
#include "checks/findings.h"
#include "checks/shares.h"
#include "formats/files/npy.h"

namespace throng::checks {

namespace {

constexpr std::uint32_t kGroundInstance = 0xFF0000;

}  // namespace

void check_density_is_heads(const formats::Image& image, const std::string& path,
                            const formats::FloatMap& map, double sigma_px, Findings& findings) {
  std::vector<Eigen::Vector2d> heads;
  for (const formats::Person& person : image.people) {
    if (person.head) heads.push_back(*person.head);
  }
  const annotate::DensityMap expected =
      annotate::density_map(heads, image.width, image.height, sigma_px);
  // Heads were not rounded as their records are, which moves a kernel by less than this
  // share.
  constexpr double kShareOfPeak = 2e-3;
  const double slack = kShareOfPeak / (2 * std::numbers::pi * sigma_px * sigma_px);
  for (std::size_t i = 0; i < map.value.size(); ++i) {
    const double off = std::abs(static_cast<double>(map.value[i]) - expected.value[i]);
    if (off <= slack + kShareOfPeak * static_cast<double>(expected.value[i])) continue;
    const auto width = static_cast<std::size_t>(image.width);
    findings.add("density-is-heads", path, fmt::format("image {}", image.id),
                 fmt::format("{} at pixel ({}, {}), but the heads give {}", map.value[i], i % width,
                             i / width, expected.value[i]));
    return;
  }
}

void check_camera(const formats::Image& image, Findings& findings) {
  constexpr double kSlack = 1e-6;
  const nlohmann::json& written = image.record.at("camera").at("centre");
  const Eigen::Vector3d center(written.at(0).get<double>(), written.at(1).get<double>(),
                               written.at(2).get<double>());
  const bool turns =
      (image.R * image.R.transpose() - Eigen::Matrix3d::Identity()).norm() < kSlack &&
      image.R.determinant() > 0;
  if (!turns || !((image.R * center + image.t).norm() < kSlack * (1 + center.norm()))) {
    findings.add("camera", formats::kCocoFile, fmt::format("image {}", image.id),
                 turns ? "the camera's center is not where R and t put it" : "R is no rotation");
  }
}

void check_ground_depth(const formats::Image& image, const std::string& path,
                        const std::vector<std::uint32_t>& ids,
                        const std::vector<std::uint16_t>& centimeters, Findings& findings) {
  constexpr std::size_t kStep = 97;  // every so many pixels; coprime to usual widths
  constexpr double kRelative = 0.005;
  constexpr double kAbsoluteM = 0.03;
  constexpr double kReliefM = 0.003;  // pavement and paint lie on the plane
  constexpr double kMaxWrong = 0.02;  // pixels at the edge of something nearer
  const Eigen::Matrix3d to_world = image.R.transpose() * image.camera_matrix.inverse();
  const double height = (image.R.transpose() * -image.t).z();
  std::size_t looked_at = 0;
  std::size_t wrong = 0;
  double found_m = 0;
  double expected_m = 0;
  for (std::size_t i = 0; i < ids.size(); i += kStep) {
    if (ids[i] != kGroundInstance || centimeters[i] == 0) continue;
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t row = i / width;
    const std::size_t column = i % width;
    const Eigen::Vector3d ray =
        to_world * Eigen::Vector3d(static_cast<double>(column), static_cast<double>(row), 1);
    if (ray.z() >= 0) continue;
    ++looked_at;
    const double z = -height / ray.z();
    const double shown = centimeters[i] / 100.0;
    const double relief_m = kReliefM * z / std::max(height, kReliefM);
    if (std::abs(shown - z) <= kAbsoluteM + kRelative * z + relief_m) continue;
    if (wrong++ == 0) {
      found_m = shown;
      expected_m = z;
    }
  }
  if (!is_above_share(wrong, looked_at, kMaxWrong)) return;
  findings.add("depth-of-ground", path, fmt::format("image {}", image.id),
               fmt::format("{} of {} looked at are off: {:.2f} m, but the camera is {:.2f} m from "
                           "the ground there",
                           wrong, looked_at, found_m, expected_m));
}

}  // namespace throng::checks
