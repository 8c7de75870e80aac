// Checks that a hazard in the open shows fire, smoke or gas by its kind and age.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "checks/run_checks.h"
#include "formats/dataset/image_camera.h"
#include "formats/files/json_vectors.h"

namespace throng::checks {

using nlohmann::json;

namespace {

constexpr std::array<const char*, 3> kMatterNames = {"fire", "smoke", "gas"};

/// Opacity of each matter at points above a hazard's middle that nothing hides.
struct Sight {
  std::size_t points = 0;
  std::array<int, 3> max_opacity{};
};

/// Looks at a column of the radius that flames have, up to the height of a person.
Sight look_at(const Pixels& pixels, const camera::Camera& camera, const json& hazard) {
  constexpr double kFlameShare = 0.5;
  constexpr double kHideM = 0.3;
  constexpr double kNearM = 2;
  constexpr int kAngles = 16;
  const Eigen::Vector2d center = formats::numbers_at<2>(hazard.at("position"));
  const double radius_m = kFlameShare * hazard.at("radius_m").get<double>();
  Sight sight;
  for (int i = 0; i < kAngles; ++i) {
    const double angle = 2 * std::numbers::pi * i / kAngles;
    for (const double share : {0.2, 0.5, 0.8, 1.0}) {
      for (const double z : {0.4, 0.9, 1.4}) {
        const Eigen::Vector3d point(center.x() + share * radius_m * std::cos(angle),
                                    center.y() + share * radius_m * std::sin(angle), z);
        const auto seen = camera.project(point);
        if (!seen.visible || seen.depth_m < kNearM) continue;
        const int x = static_cast<int>(std::lround(seen.pixel.x()));
        const int y = static_cast<int>(std::lround(seen.pixel.y()));
        if (!pixels.holds(x, y)) continue;
        const std::size_t pixel = pixels.at(x, y);
        const bool is_sky = pixels.depth_cm[pixel] == 0;
        if (!is_sky && pixels.depth_m(pixel) < seen.depth_m - kHideM) continue;
        ++sight.points;
        for (std::size_t channel = 0; channel < kMatterNames.size(); ++channel) {
          sight.max_opacity.at(channel) = std::max<int>(sight.max_opacity.at(channel),
                                                        pixels.hazard_opacity[3 * pixel + channel]);
        }
      }
    }
  }
  return sight;
}

/// Whether the image shows all of what is within 6 m of a hazard, where its smoke is thickest.
bool shows_surroundings(const Pixels& pixels, const camera::Camera& camera, const json& hazard) {
  constexpr double kAroundM = 6;
  constexpr double kHighM = 4;
  constexpr int kAngles = 8;
  const Eigen::Vector2d center = formats::numbers_at<2>(hazard.at("position"));
  for (int i = 0; i < kAngles; ++i) {
    const double angle = 2 * std::numbers::pi * i / kAngles;
    for (const double z : {0.0, kHighM}) {
      const auto seen = camera.project(
          {center.x() + kAroundM * std::cos(angle), center.y() + kAroundM * std::sin(angle), z});
      if (!seen.visible || !pixels.holds(static_cast<int>(std::lround(seen.pixel.x())),
                                         static_cast<int>(std::lround(seen.pixel.y())))) {
        return false;
      }
    }
  }
  return true;
}

std::array<int, 3> max_of_image(const Pixels& pixels) {
  std::array<int, 3> found{};
  for (std::size_t i = 0; i < pixels.hazard_opacity.size(); ++i) {
    found.at(i % 3) = std::max<int>(found.at(i % 3), pixels.hazard_opacity[i]);
  }
  return found;
}

/// Least of the greatest opacities, 0 where there may be none.
struct MinOpacity {
  std::array<int, 3> in_column{};  ///< at the points that look_at() looks at
  std::array<int, 3> in_image{};   ///< if the image shows the surroundings
};

/// By the kind of a hazard, its age and the environment's share of smoke. Measured on 35 runs of
/// seven places, smoke from 0.15 to 1, in still air and in wind: fires have 174 or more of 255 in
/// the column, and from 3 s on smoke and gas have 60 a unit of smoke there; with half or more of
/// the smoke they have 160 or more in the image from 5 s on, and smoke in still air has 139 or more
/// in the column.
MinOpacity min_opacity(const std::string& kind, double age_s, double smoke, double wind_mps) {
  constexpr double kGrownS = 3;  // until then few puffs have risen
  constexpr double kThickS = 5;
  constexpr double kLittleSmoke = 0.15;
  constexpr double kMuchSmoke = 0.5;
  constexpr int kFire = 135;
  constexpr int kThick = 140;
  constexpr double kFireballS = 2.5;
  MinOpacity least;
  if (kind == "explosion" && age_s < kFireballS) least.in_column[0] = 1;
  if (age_s < kGrownS) return least;
  const bool is_fire = kind == "fire";
  if (is_fire) least.in_column[0] = smoke < kLittleSmoke ? 1 : kFire;
  const bool smokes = is_fire || kind == "explosion" || kind == "collapse";
  if (!smokes && kind != "gas") return least;
  const std::size_t channel = smokes ? 1 : 2;
  least.in_column.at(channel) = 1;
  if (age_s < kThickS || smoke < kMuchSmoke) return least;
  least.in_image.at(channel) = kThick;
  constexpr double kStillMps = 0.45;
  constexpr double kMoreSmoke = 0.6;
  if (smokes && smoke >= kMoreSmoke && wind_mps <= kStillMps) least.in_column[1] = kThick;
  return least;
}

/// Fire of explosions alone lasts for 4 s.
bool may_burn(const formats::Image& image, const json& hazards) {
  constexpr double kFireballS = 4.1;
  return std::any_of(hazards.begin(), hazards.end(), [&](const json& hazard) {
    const std::string kind = hazard.at("kind");
    return kind == "fire" ||
           (kind == "explosion" && image.time_s - hazard.at("start_s").get<double>() <= kFireballS);
  });
}

}  // namespace

void HazardSightCheck::add_pixels(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                                  const Pixels& pixels, Findings& findings) {
  const auto hazards = image.record.find("hazards");
  if (hazards == image.record.end() || pixels.hazard_opacity.empty()) return;
  const json environment = image.record.value("environment", json::object());
  const double smoke = environment.value("smoke", 0.0);
  constexpr double kUnknownMps = 99;
  const double wind_mps = environment.value("wind", json::object()).value("speed_mps", kUnknownMps);
  const std::string file = raster_name("hazard_opacity", image);
  const std::string record = fmt::format("image {}", image.id);
  if (smoke == 0) {
    const bool is_clear = std::all_of(pixels.hazard_opacity.begin(), pixels.hazard_opacity.end(),
                                      [](std::uint16_t value) { return value == 0; });
    if (!is_clear) {
      findings.add("hazard-opacity", file, record, "fire, smoke or gas, but smoke is 0");
    }
    return;
  }
  const std::array<int, 3> in_image = max_of_image(pixels);
  const auto fault = [&](const std::string& what) {
    findings.add("hazard-opacity", file, record, what);
  };
  if (in_image[0] > 0 && !hazards->empty() && !may_burn(image, *hazards)) {
    fault("fire, but no hazard burns any more");
  }
  if (pixels.depth_cm.empty() || !is_shot_at_once(image)) return;
  const camera::Camera camera = formats::image_camera(image);
  for (const json& hazard : *hazards) {
    const auto kind = hazard.at("kind").get<std::string>();
    const double age_s = image.time_s - hazard.at("start_s").get<double>();
    const Sight sight = look_at(pixels, camera, hazard);
    const Eigen::Vector2d center = formats::numbers_at<2>(hazard.at("position"));
    constexpr std::size_t kMinPoints = 60;
    constexpr double kMinRadiusPx = 4;
    if (sight.points < kMinPoints ||
        formats::pixels_across(camera, {center.x(), center.y(), 1},
                               hazard.at("radius_m").get<double>()) < kMinRadiusPx) {
      continue;
    }
    const MinOpacity least = min_opacity(kind, age_s, smoke, wind_mps);
    const bool is_whole = shows_surroundings(pixels, camera, hazard);
    for (std::size_t channel = 0; channel < kMatterNames.size(); ++channel) {
      const bool is_enough = sight.max_opacity.at(channel) >= least.in_column.at(channel) &&
                             (!is_whole || in_image.at(channel) >= least.in_image.at(channel));
      if (is_enough) continue;
      fault(
          fmt::format("hazard {} is of kind {}, in the open and {:.1f} s old, but has {} of {} of "
                      "255 at most",
                      hazard.at("id").dump(), kind, age_s, kMatterNames.at(channel),
                      is_whole ? in_image.at(channel) : sight.max_opacity.at(channel)));
    }
  }
}

}  // namespace throng::checks
