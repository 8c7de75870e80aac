// The light in the air of a place on a grid, for what moves: people, drones, smoke.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/light/light_bake.h"
#include "world/stand.h"

namespace throng::render {

/// Probes about 2 m apart in two layers above the ground, or above the rows of stands, and one for
/// the open air above.
class ProbeGrid {
 public:
  /// Heights of the layers (m): of knees, and of heads.
  static constexpr std::array<float, 2> kHeightsM = {0.6F, 1.8F};

  ProbeGrid() = default;
  /// A grid over the ground and its stands, without light; `with_probes` false: only the one in the
  /// open.
  ProbeGrid(const Eigen::AlignedBox2d& ground, std::span<const world::Stand> stands,
            bool with_probes);

  /// Number of probes, the last in the open.
  std::size_t size() const { return fields_.size(); }
  Eigen::Vector3f position(std::size_t probe) const;
  /// Sets the light of all probes; those without a value, within buildings, take their neighbors'.
  void set(const std::vector<std::optional<LightField>>& fields);

  /// The light at a point, interpolated.
  LightField at(const Eigen::Vector3f& point) const;
  const LightField& open() const { return fields_.back(); }
  /// Multiplies all light.
  void expose(float exposure);

 private:
  Eigen::Vector2f from_ = Eigen::Vector2f::Zero();
  float spacing_m_ = 2;
  Eigen::Vector2i count_ = Eigen::Vector2i::Zero();
  std::vector<float> floor_m_;  ///< by column; empty if all are 0
  std::vector<LightField> fields_ = {LightField{}};
};

}  // namespace throng::render
