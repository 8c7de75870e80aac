// Diffuse light by rays: what reaches a point from the sky, from lamps, and after the first two
// bounces. Direct sunlight is not in it, which the shadow map gives at every pixel.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/light/ray_scene.h"
#include "render/light/sky_light.h"
#include "render/scenery/daylight.h"
#include "render/scenery/lamps.h"

namespace throng::render {

/// Light in a point from everywhere: a surface with unit normal n receives even + toward^T n.
struct LightField {
  /// The numbers of a field: even, then the columns of toward.
  static constexpr std::size_t kNumbers = 12;
  Eigen::Array3f even = Eigen::Array3f::Zero();
  Eigen::Matrix3f toward = Eigen::Matrix3f::Zero();  ///< a column per color

  /// Linear RGB of the light that a white surface throws back.
  Eigen::Array3f received(const Eigen::Vector3f& normal) const {
    return (even + (toward.transpose() * normal).array()).max(0.0F);
  }

  std::array<float, kNumbers> numbers() const {
    std::array<float, kNumbers> all{};
    std::copy_n(even.data(), 3, all.begin());
    std::copy_n(toward.data(), 9, all.begin() + 3);
    return all;
  }
};

/// The light of a place. Colors are in units of daylight.h before exposure. Answers depend on
/// nothing but the arguments.
class LightRays {
 public:
  /// `scene` must be built and outlive this object.
  LightRays(const RayScene& scene, const SkyLight& sky, const Daylight& day,
            std::vector<Lamp> lamps);

  /// Light that a white surface at a point with this normal receives, from `paths` paths; no value
  /// inside a building.
  std::optional<Eigen::Array3f> received(const Eigen::Vector3f& point,
                                         const Eigen::Vector3f& normal, int paths) const;

  /// The light in a point, past what is less than `skipped_m` away; no value inside a building.
  std::optional<LightField> field(const Eigen::Vector3f& point, int paths,
                                  float skipped_m = 0) const;

  /// The radiance that arrives against a direction; used by scripts/sheets/light_sheet.cpp, too.
  /// `number` chooses the path.
  Eigen::Array3f radiance(const Eigen::Vector3f& from, const Eigen::Vector3f& direction,
                          int bounces, std::uint32_t number, bool& from_behind,
                          float skipped_m = 0) const;

 private:
  /// The light that a surface receives straight from the sun and from lamps.
  Eigen::Array3f direct(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                        std::uint32_t number) const;
  struct Beam {
    Eigen::Vector3f direction;
    float strength = 0;  ///< on a surface that faces it, in units of lamp light
    Eigen::Array3f color;
    float distance_m = 0;
  };
  std::optional<Beam> beam(const Lamp& lamp, const Eigen::Vector3f& point) const;
  std::size_t cell_index(const Eigen::Vector2i& cell) const;
  const std::vector<std::size_t>& lamps_near(const Eigen::Vector3f& point) const;
  Eigen::Array3f one_lamp(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                          std::uint32_t number) const;

  const RayScene& scene_;
  const SkyLight& sky_;
  Eigen::Vector3f to_sun_;
  Eigen::Array3f sun_;
  bool soft_;
  Eigen::Array3f lamp_color_;
  std::vector<Lamp> lamps_;
  Eigen::Vector2f cells_from_ = Eigen::Vector2f::Zero();
  Eigen::Vector2i cells_ = Eigen::Vector2i::Zero();
  std::vector<std::vector<std::size_t>> lamps_by_cell_;
};

}  // namespace throng::render
