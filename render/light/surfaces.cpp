#include "render/light/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/buildings/building_mesh.h"
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

/// The paint of a wall or a roof.
Array3f paint(const SceneryVertex& vertex) {
  return Array3f(vertex.paint[0], vertex.paint[1], vertex.paint[2]) / 255;
}

}  // namespace

RaySurface ground_surface(std::string_view material) {
  static const std::array<std::pair<std::string_view, Array3f>, 11> kMeans = {{
      {"pavers", {0.292F, 0.274F, 0.249F}},
      {"asphalt", {0.168F, 0.166F, 0.163F}},
      {"grass", {0.118F, 0.140F, 0.053F}},
      {"concrete", {0.351F, 0.343F, 0.321F}},
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
  const auto is = [&](auto look) { return vertex.facade == static_cast<float>(look); };
  const auto shining = [&](const Array3f& albedo, float share) {
    RaySurface surface = matt(albedo);
    surface.glow = share * kWindow * lamp_color;
    return surface;
  };
  if (is(world::Facade::hedge)) return matt({0.019F, 0.034F, 0.010F});
  if (is(world::Facade::screen)) return shining(Array3f::Constant(0.10F), 0.8F);
  if (is(WallLook::open_door)) return shining(Array3f::Constant(0.08F), 0.4F);
  if (is(WallLook::closed_door)) return matt(Array3f::Constant(0.12F));
  if (is(WallLook::glazing)) return shining(Array3f::Constant(0.10F), 0.2F);
  if (is(world::Facade::glass)) return shining({0.08F, 0.085F, 0.085F}, 0.25F);
  const Array3f wall = 0.9F * paint(vertex);
  if (is(world::Facade::blank) || is(WallLook::gable) || is(WallLook::brick_gable) ||
      height < static_cast<float>(kMinStoryM)) {
    return matt(wall);
  }
  // Windows take a fifth of it, of the ground floor, with its shops, a half.
  constexpr std::uint8_t kShops = 0x80;
  const float ground_floor = (vertex.paint[3] & kShops) != 0 ? std::min(3.3F / height, 1.0F) : 0.0F;
  const float glass = 0.22F + 0.28F * ground_floor;
  return shining((1 - glass) * wall + glass * Array3f::Constant(0.09F),
                 0.05F + 0.2F * ground_floor);
}

RaySurface roof_surface(const SceneryVertex& vertex) {
  if (vertex.facade == static_cast<float>(RoofLook::hedge)) return matt({0.020F, 0.036F, 0.011F});
  return matt(paint(vertex));
}

}  // namespace throng::render
