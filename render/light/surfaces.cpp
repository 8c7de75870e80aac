#include "render/light/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/scenery/land_pattern.h"
#include "render/scenery/scenery_details.h"
#include "world/scenario.h"

namespace throng::render {

namespace {

using Eigen::Array3f;

RaySurface matt(const Array3f& albedo) {
  RaySurface surface;
  for (int i = 0; i < 3; ++i) {
    surface.albedo.at(static_cast<std::size_t>(i)) =
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(albedo[i], 0.0F, 1.0F)));
  }
  return surface;
}

/// The building's number, which the shaders derive its colors from.
int building_key(const SceneryVertex& vertex) { return static_cast<int>(vertex.id & 0xFFFFU); }

/// render_color() of shaders/wall.frag.glsl.
Array3f plaster(double pick) {
  static const std::array<Array3f, 5> kPlaster = {
      Array3f(0.56F, 0.50F, 0.40F), Array3f(0.60F, 0.57F, 0.51F), Array3f(0.52F, 0.40F, 0.29F),
      Array3f(0.45F, 0.45F, 0.43F), Array3f(0.58F, 0.47F, 0.36F)};
  return kPlaster.at(static_cast<std::size_t>(pick * 4.999));
}

}  // namespace

RaySurface ground_surface(std::string_view material) {
  static const std::array<std::pair<std::string_view, Array3f>, 11> kMeans = {{
      {"pavers", {0.340F, 0.319F, 0.289F}},
      {"asphalt", {0.168F, 0.166F, 0.163F}},
      {"grass", {0.118F, 0.140F, 0.053F}},
      {"concrete", {0.410F, 0.400F, 0.375F}},
      {"dirt", {0.257F, 0.201F, 0.133F}},
      {"kerb", {0.450F, 0.445F, 0.430F}},
      {"paint", {0.490F, 0.490F, 0.466F}},
      {"setts", {0.179F, 0.173F, 0.166F}},
      {"gutter", {0.179F, 0.173F, 0.166F}},
      {"tactile", {0.458F, 0.440F, 0.370F}},
      {"surroundings", {0.155F, 0.160F, 0.080F}},
  }};
  for (const auto& [name, albedo] : kMeans) {
    if (name == material) return matt(albedo);
  }
  return matt(Array3f::Constant(0.3F));
}

RaySurface wall_surface(const SceneryVertex& vertex, const Array3f& lamp_color) {
  constexpr float kWindow = 3.0e-4F;  // also in shaders/wall.frag.glsl
  const float height = vertex.local[3];
  const int key = building_key(vertex);
  const auto kind = static_cast<int>(std::lround(vertex.facade));
  const auto shining = [&](const Array3f& albedo, float share) {
    RaySurface surface = matt(albedo);
    surface.glow = share * kWindow * lamp_color;
    return surface;
  };
  if (kind == static_cast<int>(world::Facade::hedge)) return matt({0.019F, 0.034F, 0.010F});
  if (kind == static_cast<int>(world::Facade::screen))
    return shining(Array3f::Constant(0.10F), 0.8F);
  if (kind == static_cast<int>(WallLook::open_door)) return shining(Array3f::Constant(0.08F), 0.4F);
  if (kind == static_cast<int>(WallLook::closed_door)) return matt(Array3f::Constant(0.12F));
  if (kind == static_cast<int>(WallLook::plant)) return matt(Array3f::Constant(0.31F));
  if (kind == static_cast<int>(world::Facade::glass))
    return shining({0.08F, 0.085F, 0.085F}, 0.25F);
  const bool brick = kind == static_cast<int>(world::Facade::by_id)
                         ? cell_hash({key, 3}) < 0.4
                         : kind == static_cast<int>(world::Facade::brick);
  const Array3f wall =
      brick ? Array3f(0.32F, 0.19F, 0.14F) : Array3f(0.85F * plaster(cell_hash({key + 31, 34})));
  if (height < static_cast<float>(kMinStoryM)) return matt(wall);
  // Windows take a fifth of it, of the ground floor, with its shops, a half.
  const float ground_floor = std::min(3.3F / height, 1.0F);
  const float glass = 0.2F + 0.3F * ground_floor;
  return shining((1 - glass) * wall + glass * Array3f::Constant(0.09F),
                 0.05F + 0.2F * ground_floor);
}

RaySurface roof_surface(const SceneryVertex& vertex) {
  if (vertex.facade > 7.5F) return matt({0.020F, 0.036F, 0.011F});
  const auto tone = static_cast<float>(cell_hash({building_key(vertex), 17}));
  return matt(Array3f(0.27F, 0.26F, 0.25F) * (1 - tone) + Array3f(0.36F, 0.33F, 0.29F) * tone);
}

}  // namespace throng::render
