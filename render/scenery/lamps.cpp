#include "render/scenery/lamps.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/polygon.h"
#include "render/props/prop_shapes.h"

namespace throng::render {

namespace {

constexpr double kHeightM = 4.2;
constexpr double kSpacingM = 12;
constexpr double kMinWallM = 4;
constexpr double kReachM = 26;
constexpr double kPlaneM = 1;  // height at which the light is taken
// About 1000 candela over 54 000 lux: 57 lux on the ground below a lamp 4.2 m up.
constexpr double kStrengthM2 = 1000.0 / 54'000;
constexpr int kTexels = 256;

bool crosses(const world::Building& building, const Eigen::Vector2d& from,
             const Eigen::Vector2d& to) {
  const std::vector<Eigen::Vector2d>& corners = building.footprint;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    if (geometry::segments_cross(a, b, from, to)) return true;
  }
  return false;
}

bool is_hidden(const world::Scenario& scenario, const Lamp& lamp, const Eigen::Vector2d& point) {
  const Eigen::Vector2d from = lamp.position.head<2>();
  return std::any_of(scenario.buildings.begin(), scenario.buildings.end(),
                     [&](const auto& building) { return crosses(building, from, point); });
}

/// Adds the lamps of a prop, where its shape has them (render/props).
void add_prop_lamps(const world::Prop& prop, std::vector<Lamp>& lamps) {
  const auto add = [&](double x, double y, double z, double strength) {
    const Eigen::Vector2d at =
        prop.position + prop.scale * (Eigen::Rotation2Dd(prop.yaw_rad) * Eigen::Vector2d(x, y));
    lamps.push_back({{at.x(), at.y(), prop.scale * z}, {0, 0}, strength});
  };
  switch (prop.kind) {
    case world::PropKind::lamp_post:
      return add(0, 0, kLampPostM, 1);
    case world::PropKind::stall:
      return add(0, -0.3, 2, 0.15);
    case world::PropKind::kiosk:
      return add(0, -1.3, 2.2, 0.15);
    case world::PropKind::tent:
      return add(0, 0, 2.6, 0.4);
    case world::PropKind::stage:
      for (const double x : {-6.0, -3.0, 0.0, 3.0, 6.0}) add(x, -4, 7, 6);
      return;
    default:
      return;
  }
}

}  // namespace

std::vector<Lamp> wall_lamps(const world::Scenario& scenario) {
  constexpr double kOffWallM = 0.35;
  std::vector<Lamp> lamps;
  for (const world::Building& building : scenario.buildings) {
    if (building.height_m < kMinStoryM) continue;
    const std::vector<Eigen::Vector2d>& corners = building.footprint;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d& from = corners[i];
      const Eigen::Vector2d edge = corners[(i + 1) % corners.size()] - from;
      const double length = edge.norm();
      if (length < kMinWallM) continue;
      const Eigen::Vector2d out = Eigen::Vector2d(edge.y(), -edge.x()) / length;
      const int count = std::max(1, static_cast<int>(length / kSpacingM));
      for (int k = 0; k < count; ++k) {
        const Eigen::Vector2d at = from + edge * ((k + 0.5) / count) + kOffWallM * out;
        lamps.push_back({{at.x(), at.y(), std::min(kHeightM, 0.8 * building.height_m)}, out});
      }
    }
  }
  return lamps;
}

std::vector<Lamp> all_lamps(const world::Scenario& scenario) {
  std::vector<Lamp> lamps = wall_lamps(scenario);
  for (const world::Prop& prop : scenario.props) add_prop_lamps(prop, lamps);
  return lamps;
}

Eigen::Vector4f lamp_light_at(const world::Scenario& scenario, const std::vector<Lamp>& lamps,
                              const Eigen::Vector2d& point) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (const Lamp& lamp : lamps) {
    const Eigen::Vector3d to_lamp = lamp.position - Eigen::Vector3d(point.x(), point.y(), kPlaneM);
    const double distance = to_lamp.norm();
    if (distance > kReachM || lamp.away.dot(to_lamp.head<2>()) > 0.05) continue;
    if (is_hidden(scenario, lamp, point)) continue;
    const Eigen::Vector3d direction = to_lamp / distance;
    // Street lamps throw their light wide, and none above the horizontal.
    const double down = std::sqrt(std::max(direction.z(), 0.0));
    const double rim = 1 - std::pow(distance / kReachM, 4);
    const double strength = lamp.strength * kStrengthM2 * down * rim * rim / (distance * distance);
    sum.head<3>() += strength * direction;
    sum.w() += strength;
  }
  return sum.cast<float>();
}

LampMap::LampMap(const world::Scenario& scenario)
    : area_(scenario.ground.min, scenario.ground.max),
      texture_(make_texture_2d(GL_RGBA16F, kTexels, kTexels)) {
  const std::vector<Lamp> lamps = all_lamps(scenario);
  std::vector<Eigen::Vector4f> texels;
  texels.reserve(static_cast<std::size_t>(kTexels) * kTexels);
  for (int row = 0; row < kTexels; ++row) {
    for (int column = 0; column < kTexels; ++column) {
      const Eigen::Array2d share((column + 0.5) / kTexels, (row + 0.5) / kTexels);
      const Eigen::Vector2d point = area_.min().array() + share * area_.sizes().array();
      texels.push_back(lamp_light_at(scenario, lamps, point));
    }
  }
  const GLuint name = texture_.name();
  glTextureSubImage2D(name, 0, 0, 0, kTexels, kTexels, GL_RGBA, GL_FLOAT, texels.data());
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void LampMap::bind() const { glBindTextureUnit(2, texture_.name()); }

}  // namespace throng::render
