#include "render/scenery/lighting.h"

#include <algorithm>
#include <cmath>

namespace throng::render {

namespace {

std::array<float, 4> four(const Eigen::Array3d& v, double w = 0) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

std::array<float, 4> box_corners(const Eigen::AlignedBox2d& area) {
  return {static_cast<float>(area.min().x()), static_cast<float>(area.min().y()),
          static_cast<float>(1 / area.sizes().x()), static_cast<float>(1 / area.sizes().y())};
}

/// Places [low, high] on a grid: the length grows in steps of about a fifth, the start moves in
/// whole texels.
void snap(double& low, double& high) {
  constexpr double kStepsPerOctave = 4;
  const double texels = kShadowSize;
  const double needed = std::max(high - low, 4.0) * (1 + 4 / texels);
  const double length = std::exp2(std::ceil(std::log2(needed) * kStepsPerOctave) / kStepsPerOctave);
  const double texel = length / texels;
  const double middle = 0.5 * (low + high);
  low = std::floor((middle - 0.5 * length) / texel) * texel;
  high = low + length;
}

/// Whether a disaster has flames.
bool burns(const world::Disaster& disaster) {
  return disaster.kind == world::DisasterKind::fire ||
         disaster.kind == world::DisasterKind::explosion;
}

/// Light of a fire's flames on a white surface that faces it in 1 m, over the square of its reach
/// in m, in units of daylight (54,000 lux). A square meter of a large pool fire releases about
/// 0.5 MW (Babrauskas 1983), flames cover a third of the disc that it reaches, and their light is
/// taken as 0.1 lm/W, as a candle's.
constexpr double kFireLight = 0.1 * 0.5e6 * 0.36 / 4 / 54000;

/// At night a camera closes before what a fire lights becomes white: its light counts as if the
/// exposure were no longer than this.
constexpr double kMaxFireExposure = 40;

}  // namespace

std::string light_words(const Environment& environment,
                        std::span<const world::Disaster> disasters) {
  const Daylight light = daylight(environment);
  std::string words;
  if (light.dark) words += "#define NO_SUN\n";
  if (light.soft) words += "#define SOFT\n";
  if (light.lamps_on) words += "#define LAMPS\n";
  if (environment.weather == Weather::rain) words += "#define WET\n";
  if (environment.smoke > 0 && std::any_of(disasters.begin(), disasters.end(), burns)) {
    words += "#define FIRES\n";
  }
  return words;
}

double burning_share(const world::Disaster& disaster, double time_s) {
  constexpr double kFireballS = 4;
  const double age_s = time_s - disaster.start_s;
  if (!burns(disaster) || age_s < 0) return 0;
  if (disaster.kind == world::DisasterKind::fire) return 1;
  return std::max(1 - age_s / kFireballS, 0.0);
}

std::vector<Fire> fires_at(const Environment& environment,
                           std::span<const world::Disaster> disasters, double time_s,
                           const Eigen::Vector3d& eye) {
  std::vector<Fire> fires;
  for (const world::Disaster& disaster : disasters) {
    if (!burns(disaster) || time_s < disaster.start_s) continue;
    fires.push_back({disaster.position, disaster.reach_m(time_s),
                     environment.smoke * burning_share(disaster, time_s)});
  }
  if (environment.smoke <= 0) fires.clear();
  const auto light = [&](const Fire& fire) {
    return fire.reach_m / ((fire.position - eye.head<2>()).norm() + 1);
  };
  std::stable_sort(fires.begin(), fires.end(),
                   [&](const Fire& a, const Fire& b) { return light(a) > light(b); });
  fires.resize(std::min(fires.size(), kMaxFires));
  return fires;
}

Eigen::Vector2d shadow_slope(const Daylight& light) {
  return light.direction.head<2>() / light.direction.z();
}

Eigen::AlignedBox2d shadow_area(const ClipPlanes& planes, const Eigen::AlignedBox2d& ground,
                                double tallest_m, const Eigen::Vector2d& slope) {
  Eigen::AlignedBox2d area;
  for (const double height : {0.0, tallest_m}) {
    Eigen::AlignedBox2d seen = visible_part(planes, ground, height);
    if (seen.isEmpty()) continue;
    area.extend(seen.translate(-slope * height));
  }
  if (area.isEmpty()) area.extend(ground.center());
  snap(area.min().x(), area.max().x());
  snap(area.min().y(), area.max().y());
  return area;
}

LightBlock light_block(const Daylight& light, const LightFrame& frame) {
  const Eigen::Array3d ground_albedo(0.33, 0.31, 0.28);
  const Eigen::Array3d bounce = 0.8 * ground_albedo * (light.sun * light.direction.z() + light.sky);
  const Eigen::Vector2d slope = shadow_slope(light);
  constexpr double kSunRadius = 0.00465;  // of its disc in the sky, rad
  constexpr double kLog2OfE = 1.4426950408889634;
  LightBlock block;
  block.sun_direction = four(light.direction);
  block.sun = four(light.sun);
  block.sky = four(light.sky, light.film_black);
  block.bounce = four(bounce);
  block.haze = four(light.haze, light.extinction_per_m * kLog2OfE);
  block.shadow_area = box_corners(frame.shadow_area);
  block.shadow_slope = {static_cast<float>(slope.x()), static_cast<float>(slope.y()),
                        static_cast<float>(1 / frame.tallest_m),
                        static_cast<float>(kSunRadius / light.direction.z())};
  block.zenith = four(light.zenith, frame.exposure_gain);
  block.lamps = four(light.lamps);
  block.eye = four(frame.eye, frame.time_s);
  for (std::size_t i = 0; i < frame.fires.size(); ++i) {
    const Fire& fire = frame.fires[i];
    const double strength = kFireLight * fire.reach_m * fire.reach_m * fire.strength *
                            std::min(light.exposure, kMaxFireExposure);
    block.fires.at(i) = {static_cast<float>(fire.position.x()),
                         static_cast<float>(fire.position.y()), static_cast<float>(fire.reach_m),
                         static_cast<float>(strength)};
  }
  return block;
}

}  // namespace throng::render
