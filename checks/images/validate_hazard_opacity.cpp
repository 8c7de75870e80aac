// Opacity of fire, smoke and gas against the hazards of the image's record.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "base/geometry/angle.h"
#include "checks/run_checks.h"
#include "checks/shares.h"
#include "formats/dataset/image_camera.h"
#include "formats/files/json_vectors.h"
#include "spec/sim/wind_spec.h"

namespace throng::checks {

namespace {

/// A channel of hazard_opacity/ (docs/formats_pixels.md) and the space that it keeps to about a
/// hazard of radius r: a cylinder of radius beyond_m + beyond_per_m r and height
/// height_m + height_per_m r, which is also there where the air carries it to in carried_s. They
/// bound what render/passes/smoke_pass.cpp draws: how far puffs are thrown, rise and widen.
struct Matter {
  std::string_view name;
  std::array<std::string_view, 3> kinds;  ///< of hazards that make it
  double beyond_m;
  double beyond_per_m;
  double height_m;
  double height_per_m;
  double carried_s;
};

constexpr std::array kMatters = {
    Matter{"fire", {"fire", "explosion"}, 1.8, 1.1, 2.5, 2.3, 0.5},
    Matter{"smoke", {"fire", "explosion", "collapse"}, 8.4, 1.43, 17, 0.43, 15},
    Matter{"gas", {"gas"}, 8.4, 1.43, 17, 0.43, 15}};

/// The wind in an image's record, as far as its mean is concerned.
sim::WindSpec recorded_wind(const formats::Image& image) {
  const nlohmann::json environment = image.record.value("environment", nlohmann::json::object());
  const nlohmann::json record = environment.value("wind", nlohmann::json::object());
  sim::WindSpec wind;
  wind.speed_mps = record.value("speed_mps", wind.speed_mps);
  wind.direction_rad = record.value("direction_deg", 0.0) * kDegree;
  const std::string profile = record.value("profile", "");
  wind.profile = profile == "log"     ? sim::WindProfile::log_law
                 : profile == "power" ? sim::WindProfile::power_law
                                      : sim::WindProfile::uniform;
  wind.roughness_m = record.value("roughness_m", wind.roughness_m);
  wind.exponent = record.value("exponent", wind.exponent);
  return wind;
}

/// How the air moves smoke: with the wind at 5 m, but not faster than 2.5 m/s; in still air at
/// 0.45 m/s in a direction that nothing records.
struct Drift {
  Eigen::Vector2d along_mps = Eigen::Vector2d::Zero();
  double anywhere_mps = 0;
};

Drift find_drift(const formats::Image& image) {
  constexpr double kSmokeM = 5;
  constexpr double kSlowestMps = 0.45;
  constexpr double kFastestMps = 2.5;
  const Eigen::Vector2d wind_mps = recorded_wind(image).mean_at(kSmokeM).head<2>();
  const double speed_mps = wind_mps.norm();
  if (!(speed_mps > kSlowestMps)) return {Eigen::Vector2d::Zero(), kSlowestMps};
  return {wind_mps * (std::min(speed_mps, kFastestMps) / speed_mps), 0};
}

/// Bounds of that space in the image; nothing if some of it is beside or behind the camera.
std::optional<Eigen::AlignedBox2d> bounds_in(const camera::Camera& camera, const Matter& matter,
                                             const Drift& drift, const nlohmann::json& hazard) {
  constexpr int kCorners = 24;
  const Eigen::Vector2d center = formats::numbers_at<2>(hazard.at("position"));
  const double hazard_radius_m = hazard.at("radius_m").get<double>();
  const double radius_m = matter.beyond_m + matter.beyond_per_m * hazard_radius_m +
                          matter.carried_s * drift.anywhere_mps;
  const double height_m = matter.height_m + matter.height_per_m * hazard_radius_m;
  Eigen::AlignedBox2d bounds;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const Eigen::Vector2d rim =
        center + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    for (const double carried_s : {0.0, matter.carried_s}) {
      for (const double z : {0.0, height_m}) {
        const Eigen::Vector2d at = rim + carried_s * drift.along_mps;
        const auto seen = camera.project({at.x(), at.y(), z});
        if (!seen.visible) return std::nullopt;
        bounds.extend(seen.pixel);
      }
    }
  }
  return bounds;
}

/// The hazards of an image that make a matter.
struct Makers {
  bool exist = false;
  bool are_bounded = true;  ///< all of them are in front of the camera
  std::vector<Eigen::AlignedBox2d> bounds;

  bool are_near(int x, int y) const {
    return std::any_of(bounds.begin(), bounds.end(),
                       [&](const auto& box) { return box.contains(Eigen::Vector2d(x, y)); });
  }
};

Makers find_makers(const formats::Image& image, const camera::Camera& camera, const Matter& matter,
                   const nlohmann::json& hazards) {
  Makers makers;
  const Drift drift = find_drift(image);
  for (const nlohmann::json& hazard : hazards) {
    const auto kind = hazard.at("kind").get<std::string>();
    if (std::find(matter.kinds.begin(), matter.kinds.end(), kind) == matter.kinds.end()) continue;
    makers.exist = true;
    const auto box = bounds_in(camera, matter, drift, hazard);
    makers.are_bounded = makers.are_bounded && box.has_value();
    if (box) makers.bounds.push_back(*box);
  }
  return makers;
}

}  // namespace

void HazardOpacityCheck::add_pixels(const formats::DatasetInfo& /*info*/,
                                    const formats::Image& image, const Pixels& pixels,
                                    Findings& findings) {
  const auto hazards = image.record.find("hazards");
  if (pixels.hazard_opacity.empty() || hazards == image.record.end()) return;
  if (!hazards->empty()) runs_with_hazards_.insert(image.run);
  const camera::Camera camera = formats::image_camera(image);
  for (std::size_t channel = 0; channel < kMatters.size(); ++channel) {
    const Matter& matter = kMatters.at(channel);
    const Makers makers = find_makers(image, camera, matter, *hazards);
    std::size_t shown = 0;
    std::size_t beside = 0;
    for (int y = 0; y < pixels.height; ++y) {
      for (int x = 0; x < pixels.width; ++x) {
        if (pixels.hazard_opacity[3 * pixels.at(x, y) + channel] == 0) continue;
        ++shown;
        beside += makers.are_near(x, y) ? 0 : 1;
      }
    }
    if (shown == 0) continue;
    const std::string file = raster_name("hazard_opacity", image);
    const std::string record = fmt::format("image {}", image.id);
    constexpr double kMaxBesideShare = 0.02;
    if (!makers.exist) {
      without_hazard_.push_back(
          {image.run, file, record,
           fmt::format("{} in {} pixels, but no hazard that makes it has begun", matter.name,
                       shown)});
    } else if (makers.are_bounded && is_above_share(beside, shown, kMaxBesideShare)) {
      findings.add("hazard-opacity", file, record,
                   fmt::format("{} in {} pixels, {} of them far from every hazard", matter.name,
                               shown, beside));
    }
  }
}

// Agents of some scenarios are dangers that smoke and are no hazards; runs have them or hazards.
void HazardOpacityCheck::finish(const formats::DatasetInfo& /*info*/, Findings& findings) {
  for (const Unexplained& found : without_hazard_) {
    if (!runs_with_hazards_.contains(found.run)) continue;
    findings.add("hazard-opacity", found.file, found.record, found.text);
  }
}

}  // namespace throng::checks
