#include "render/lighting.h"

#include <algorithm>
#include <cmath>

namespace throng::render {

namespace {

std::array<float, 4> four(const Eigen::Vector3d& v, double w = 0) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

/// film() of shaders/light.glsl.
float film(float radiance) {
  const float x = std::max(radiance - 0.004F, 0.0F);
  return (x * (6.2F * x + 0.5F)) / (x * (6.2F * x + 1.7F) + 0.06F);
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

}  // namespace

Eigen::Vector3d sun_direction(const Lighting& lighting) {
  const double elevation = std::max(lighting.sun_elevation_rad, 0.05);
  return {std::cos(elevation) * std::cos(lighting.sun_azimuth_rad),
          std::cos(elevation) * std::sin(lighting.sun_azimuth_rad), std::sin(elevation)};
}

Eigen::Vector2d shadow_slope(const Lighting& lighting) {
  const Eigen::Vector3d sun = sun_direction(lighting);
  return sun.head<2>() / sun.z();
}

Eigen::AlignedBox2d shadow_area(const ClipPlanes& planes, const Eigen::AlignedBox2d& place,
                                double tallest_m, const Eigen::Vector2d& slope) {
  Eigen::AlignedBox2d area;
  for (const double height : {0.0, tallest_m}) {
    Eigen::AlignedBox2d seen = visible_part(planes, place, height);
    if (seen.isEmpty()) continue;
    area.extend(seen.translate(-slope * height));
  }
  if (area.isEmpty()) area.extend(place.center());
  snap(area.min().x(), area.max().x());
  snap(area.min().y(), area.max().y());
  return area;
}

LightBlock light_block(const Lighting& lighting, const Eigen::AlignedBox2d& area,
                       double tallest_m) {
  const Eigen::Vector3d direction = sun_direction(lighting);
  // A lower sun shines through more air: weaker and warmer (optical depths for clear air).
  const double air_mass = 1 / (direction.z() + 0.05);
  Eigen::Array3d sun = 1.85 * (-Eigen::Array3d(0.08, 0.14, 0.24) * air_mass).exp();
  Eigen::Array3d sky = Eigen::Array3d(0.34, 0.395, 0.475) * (0.55 + 0.45 * direction.z());
  // The camera opens up as it gets darker, as automatic exposure does, but not all the way.
  constexpr double kNoonIlluminance = 1.55;
  const double exposure = std::pow(kNoonIlluminance / (sun * direction.z() + sky).mean(), 0.7);
  sun *= exposure;
  sky *= exposure;
  const Eigen::Array3d ground_albedo(0.33, 0.31, 0.28);
  const Eigen::Array3d bounce = 0.8 * ground_albedo * (sun * direction.z() + sky);
  const Eigen::Vector2d slope = shadow_slope(lighting);
  LightBlock block;
  block.sun_direction = four(direction);
  block.sun = four(sun);
  block.sky = four(sky);
  block.bounce = four(bounce);
  block.haze = four({0.62, 0.70, 0.80}, 1 / 900.0);
  block.shadow_area = {static_cast<float>(area.min().x()), static_cast<float>(area.min().y()),
                       static_cast<float>(1 / area.sizes().x()),
                       static_cast<float>(1 / area.sizes().y())};
  block.shadow_slope = {static_cast<float>(slope.x()), static_cast<float>(slope.y()),
                        static_cast<float>(1 / tallest_m), 0};
  return block;
}

Eigen::Vector3f sky_colour(const LightBlock& light) {
  return {film(light.haze[0]), film(light.haze[1]), film(light.haze[2])};
}

}  // namespace throng::render
