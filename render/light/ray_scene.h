// The scene of the rays of light: the triangles of a place with their albedo and own light, in an
// acceleration structure of Embree.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/ground/scenery_mesh.h"
#include "render/props/prop_mesh.h"

namespace throng::render {

/// How a surface throws light back.
struct RaySurface {
  std::array<std::uint8_t, 3> albedo{};  ///< linear, 255: white
  Eigen::Array3f glow =
      Eigen::Array3f::Zero();  ///< own radiance, in units of daylight.h before exposure
};

/// A point where a ray ends.
struct RayHit {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;  ///< unit, toward the ray's origin
  const RaySurface* surface = nullptr;
  bool is_back = false;  ///< the ray came from behind a solid surface, as from within a building
};

/// Triangles for rays. add_*() first, then build(), then the queries, which are thread-safe.
class RayScene {
 public:
  RayScene();
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Adds a range of the scenery's triangles.
  void add(const SceneryMesh& mesh, const Range& range, const RaySurface& surface);
  /// Adds the scenery's triangle that starts at this index.
  void add_triangle(const SceneryMesh& mesh, std::size_t first, const RaySurface& surface);
  /// Adds a prop by its paint; cards of leaves let rays pass between the leaves. `lamp_color` is
  /// that of one unit of lamp light, black by day.
  void add(const PropMesh& mesh, const Eigen::Array3f& lamp_color);

  /// Ends the adding. Throws EnvironmentError if there is no memory for it.
  void build();

  /// The first surface on a ray, `skipped_m` away or more.
  std::optional<RayHit> trace(const Eigen::Vector3f& from, const Eigen::Vector3f& direction,
                              float skipped_m = 0) const;
  /// Whether nothing lies between these distances in a direction.
  bool is_free(const Eigen::Vector3f& from, const Eigen::Vector3f& direction, float distance_m,
               float skipped_m = 0) const;

  /// All that the answers depend on, for the name of what is computed from them.
  std::string fingerprint() const;

 private:
  struct Device;
  void push(const std::array<Eigen::Vector3f, 3>& corners, std::uint16_t surface, bool closed);
  std::uint16_t index_of(const RaySurface& surface);

  std::vector<Eigen::Vector3f> solid_;  ///< three corners a triangle
  std::vector<Eigen::Vector3f> leaves_;
  std::vector<Eigen::Vector2f> cards_;        ///< of the leaves' corners, as PropVertex::card
  std::vector<std::uint16_t> solid_surface_;  ///< by triangle; highest bit: closed
  std::vector<std::uint16_t> leaf_surface_;
  std::vector<RaySurface> surfaces_;
  std::map<std::array<float, 6>, std::uint16_t> known_;
  std::unique_ptr<Device> device_;
};

}  // namespace throng::render
