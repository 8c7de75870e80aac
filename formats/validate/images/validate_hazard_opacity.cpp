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

#include "formats/dataset/image_camera.h"
#include "formats/files/json_vectors.h"
#include "formats/validate/run_checks.h"

namespace throng::formats {

namespace {

/// A channel of hazard_opacity/ (docs/formats_pixels.md) and the space about a hazard, of radius
/// r, that it keeps to: a cylinder of radius 1.3 r + beyond_m and height r + height_m.
struct Matter {
  std::string_view name;
  std::array<std::string_view, 3> kinds;  ///< of hazards that make it
  double beyond_m;
  double height_m;
};

constexpr std::array kMatters = {Matter{"fire", {"fire", "explosion"}, 1.5, 3},
                                 Matter{"smoke", {"fire", "explosion", "collapse"}, 22, 28},
                                 Matter{"gas", {"gas"}, 22, 28}};

/// Bounds of that space in the image; nothing if some of it is beside or behind the camera.
std::optional<Eigen::AlignedBox2d> bounds_in(const camera::Camera& camera, const Matter& matter,
                                             const nlohmann::json& hazard) {
  constexpr int kCorners = 24;
  const Eigen::Vector2d center = numbers_at<2>(hazard.at("position"));
  const double hazard_radius_m = hazard.at("radius_m").get<double>();
  const double radius_m = 1.3 * hazard_radius_m + matter.beyond_m;
  Eigen::AlignedBox2d bounds;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    for (const double z : {0.0, matter.height_m + hazard_radius_m}) {
      const Eigen::Vector3d corner(center.x() + radius_m * std::cos(angle),
                                   center.y() + radius_m * std::sin(angle), z);
      const auto seen = camera.project(corner);
      if (!seen.visible) return std::nullopt;
      bounds.extend(seen.pixel);
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

Makers find_makers(const camera::Camera& camera, const Matter& matter,
                   const nlohmann::json& hazards) {
  Makers makers;
  for (const nlohmann::json& hazard : hazards) {
    const auto kind = hazard.at("kind").get<std::string>();
    if (std::find(matter.kinds.begin(), matter.kinds.end(), kind) == matter.kinds.end()) continue;
    makers.exist = true;
    const auto box = bounds_in(camera, matter, hazard);
    makers.are_bounded = makers.are_bounded && box.has_value();
    if (box) makers.bounds.push_back(*box);
  }
  return makers;
}

}  // namespace

void HazardOpacityCheck::add_pixels(const DatasetInfo& /*info*/, const Image& image,
                                    const Pixels& pixels, Findings& findings) {
  const auto hazards = image.record.find("hazards");
  if (pixels.hazard_opacity.empty() || hazards == image.record.end()) return;
  if (!hazards->empty()) runs_with_hazards_.insert(image.run);
  const camera::Camera camera = image_camera(image);
  for (std::size_t channel = 0; channel < kMatters.size(); ++channel) {
    const Matter& matter = kMatters.at(channel);
    const Makers makers = find_makers(camera, matter, *hazards);
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
    } else if (makers.are_bounded &&
               static_cast<double>(beside) > kMaxBesideShare * static_cast<double>(shown)) {
      findings.add("hazard-opacity", file, record,
                   fmt::format("{} in {} pixels, {} of them far from every hazard", matter.name,
                               shown, beside));
    }
  }
}

// Agents of some scenarios are dangers that smoke and are no hazards; runs have them or hazards.
void HazardOpacityCheck::finish(const DatasetInfo& /*info*/, Findings& findings) {
  for (const Unexplained& found : without_hazard_) {
    if (!runs_with_hazards_.contains(found.run)) continue;
    findings.add("hazard-opacity", found.file, found.record, found.text);
  }
}

}  // namespace throng::formats
